// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/foot_story.h"

#include <cmath>
#include <limits>
#include <string_view>

#include "poise/sim/log/columns.h"
#include "poise/tools/commands/explain/row_phrases.h"
#include "poise/tools/commands/format.h"

namespace poise {
namespace {

constexpr double kRolls = 0.02;   // Tilt, rad.
constexpr double kSlides = 5e-3;  // Displacement, m.
constexpr std::string_view kStepping = "stepping";

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

}  // namespace

FootStory::FootStory(const std::string& foot, const LogReader& log)
    : foot_(foot),
      contact_(log.Find(ContactColumn(foot))),
      tilt_(log.Find(TiltColumn(foot))),
      slide_(log.Find(SlideColumn(foot))),
      phase_(log.Find(PhaseColumn(foot))),
      plan_x_(log.Find(PlanColumn('x'))),
      plan_y_(log.Find(PlanColumn('y'))),
      beyond_(log.Find(kPlanBeyondColumn)) {}

// pre: the last phase is that of this row.
void FootStory::LookAtStep(double time, const LogReader& log) {
  const auto number = [&](const std::optional<int>& column) {
    return column ? log.Number(*column)
                  : std::numeric_limits<double>::quiet_NaN();
  };
  if (phases_.back().name != kStepping) {
    if (steps_.empty() || steps_.back().has_landed) return;
    steps_.back().has_landed = true;
    steps_.back().landing = time;
    return;
  }
  if (phases_.back().from == time) {
    steps_.push_back({time, time, 0, 0, number(beyond_), false});
  }
  FootStory::Step& step = steps_.back();
  step.landing = time;
  step.x = number(plan_x_);
  step.y = number(plan_y_);
}

void FootStory::Look(double time, const LogReader& log) {
  if (phase_) {
    const std::string_view phase = log.cell(*phase_);
    if (phases_.empty() || phases_.back().name != phase) {
      phases_.push_back({std::string(phase), time, time});
    }
    phases_.back().to = time;
    LookAtStep(time, log);
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
    if (is_down && phases_[i - 1].name == kStepping) continue;
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

std::string SayStep(const std::string& foot, const FootStory::Step& step) {
  std::string text =
      Format("%.3f s: the robot steps with the ", step.at) + Spaced(foot);
  if (!std::isnan(step.x) && !std::isnan(step.y)) {
    text += Format(", planned to (%.2f, ", step.x) + Format("%.2f) m,", step.y);
  }
  text += step.has_landed ? Format(" in %.2f s", step.landing - step.at)
                          : " and does not land";
  if (step.beyond > 0) {
    text += Format(", as the capture point is %.0f cm beyond the edge",
                   std::ceil(100 * step.beyond));
  }
  return text + ".";
}

}  // namespace poise
