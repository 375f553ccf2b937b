// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/foot_story.h"

#include <cstdio>
#include <string_view>

#include "poise/sim/log/columns.h"
#include "poise/tools/commands/explain/row_phrases.h"

namespace poise {
namespace {

constexpr double kRolls = 0.02;   // Tilt, rad.
constexpr double kSlides = 5e-3;  // Displacement, m.

// Returns words for the start of a phase, or nothing for an unknown phase.
std::string_view Begins(std::string_view phase) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {
      {"down", "is down again"},
      {"unloading", "is unloaded"},
      {"up", "is lifted"},
      {"landing", "is put down"},
      {"loading", "has landed and is loaded"},
      {"lost", "has lost contact with the ground"},
      {"free", "is released"},
      {"returning", "returns to its place"}};
  for (const auto& [name, words] : kWords) {
    if (phase == name) return words;
  }
  return "";
}

std::string Format(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

}  // namespace

FootStory::FootStory(const std::string& foot, const LogReader& log)
    : foot_(foot),
      contact_(log.Find(ContactColumn(foot))),
      tilt_(log.Find(TiltColumn(foot))),
      slide_(log.Find(SlideColumn(foot))),
      phase_(log.Find(PhaseColumn(foot))) {}

void FootStory::Look(double time, const LogReader& log) {
  if (phase_) {
    const std::string_view phase = log.cell(*phase_);
    if (phases_.empty() || phases_.back().name != phase) {
      phases_.push_back({std::string(phase), time, time});
    }
    phases_.back().to = time;
  }
  if (!contact_ || !tilt_ || !slide_ || log.Number(*contact_) != 1) return;
  if (!rolls_ && log.Number(*tilt_) > kRolls) rolls_ = time;
  if (!slides_ && log.Number(*slide_) > kSlides) slides_ = time;
}

std::vector<std::pair<double, std::string>> FootStory::Sentences() const {
  std::vector<std::pair<double, std::string>> sentences;
  const std::string foot = "the " + Spaced(foot_);
  const auto say = [&](double time, const std::string& what) {
    sentences.emplace_back(
        time, Format("%.3f s: ", time).append(foot).append(" ").append(what));
  };
  for (size_t i = 0; i < phases_.size(); ++i) {
    const std::string words(Begins(phases_[i].name));
    const bool is_down = phases_[i].name == "down";
    if (words.empty() || (is_down && i == 0)) continue;  // The initial phase.
    const bool ends = i + 1 < phases_.size() && !is_down;
    const double end = ends ? phases_[i + 1].from : 0;
    say(phases_[i].from,
        words + (ends ? Format(", for %.3g s.", end - phases_[i].from) : "."));
  }
  if (rolls_) {
    say(*rolls_, "rolls over an edge, tilted by more than 0.02 rad.");
  }
  if (slides_) say(*slides_, "has slid by more than 5 mm.");
  return sentences;
}

}  // namespace poise
