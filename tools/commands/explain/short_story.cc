// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/explain/short_story.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "poise/tools/commands/explain/ending.h"
#include "poise/tools/commands/explain/foot_story.h"
#include "poise/tools/commands/explain/momentum_cost.h"
#include "poise/tools/commands/explain/row_phrases.h"
#include "poise/tools/commands/format.h"

namespace poise {
namespace {

using nlohmann::json;

constexpr size_t kMostCauses = 2;  // Maximum number of named reasons of a loss.
constexpr size_t kMostRows = 2;    // Maximum number of named rows of a cause.
constexpr double kSmallShare = 0.1;  // Smaller shares of a loss are not named.
constexpr size_t kMostPushes = 4;    // Maximum number of named pushes.
// A push that ends earlier than planned by more was cut short, s.
constexpr double kShort = 0.005;

using TimedSentence = std::pair<double, std::string>;  // Its time, s.

// The foot that slips and the time, s.
struct Slip {
  std::string foot;
  double at;
};

// Returns the direction of a force, such as " forward" or " at 30 deg". 0 is
// forward and 90 is left.
std::string Direction(const Values& force) {
  if (force.size() < 2) return "";
  const double x = force[0].second, y = force[1].second;
  if (std::hypot(x, y) == 0) return "";
  constexpr double kDegree = M_PI / 180;
  const double degrees = std::atan2(y, x) / kDegree;
  constexpr std::pair<double, const char*> kWords[] = {{0, " forward"},
                                                       {90, " to the left"},
                                                       {180, " backward"},
                                                       {-180, " backward"},
                                                       {-90, " to the right"}};
  for (const auto& [direction, word] : kWords) {
    if (std::abs(degrees - direction) < 1) return word;
  }
  return Format(" at %.0f deg (0 forward, 90 left)", degrees);
}

// Returns a push as " forward with 100 N for 150 ms".
std::string Describe(const Span& push) {
  return Direction(push.with) +
         Format(push.peak < 100 ? " with %.3g N" : " with %.0f N", push.peak) +
         Format(" for %.0f ms", 1e3 * push.lasted());
}

// Returns the duration of the only push of a run, s.
std::optional<double> PlannedDuration(const json& summary) {
  const json pushes = summary.value("pushes", json());
  if (!pushes.is_array() || pushes.size() != 1) return std::nullopt;
  return NumberIn(pushes[0], "duration");
}

// Returns whether a push had a moment, which the log does not have.
bool HasMoment(const json& summary) {
  const json pushes = summary.value("pushes", json());
  if (!pushes.is_array()) return false;
  return std::any_of(pushes.begin(), pushes.end(), [](const json& push) {
    const json moment =
        push.is_object() ? push.value("moment", json()) : json();
    return std::any_of(moment.begin(), moment.end(),
                       [](const json& part) { return part != 0; });
  });
}

// Names all pushes, or the first ones of many, in one sentence.
TimedSentence SayPushes(const std::vector<Span>& pushes, const json& summary) {
  const size_t said = std::min(pushes.size(), kMostPushes);
  std::string text = Format("%.3f s: the robot is pushed", pushes[0].from) +
                     Describe(pushes[0]);
  for (size_t i = 1; i < said; ++i) {
    text += Format(i + 1 == pushes.size() ? " and at %.3f s" : ", at %.3f s",
                   pushes[i].from) +
            Describe(pushes[i]);
  }
  if (said < pushes.size()) {
    text += " and " + std::to_string(pushes.size() - said) + " more times";
  }
  const auto impulse = NumberIn(summary, "impulse_Ns");
  if (impulse && pushes.size() == 1) {
    const auto planned = PlannedDuration(summary);
    text += planned && pushes[0].lasted() < *planned - kShort
                ? Format(" of the planned %.0f ms, in all", 1e3 * *planned)
                : ",";
    text += Format(" an impulse of %.1f N s", *impulse);
  }
  return {pushes[0].from, text + "."};
}

// Returns the first foot that slides while it is flat on the ground, before the
// robot is lost. The ground then has less friction than the controller assumes.
std::optional<Slip> FindSlip(const RunStory& story, const json& summary) {
  const double end =
      story.momentum.is_lost()
          ? story.momentum.lost_at()
          : NumberIn(summary, "fell_at")
                .value_or(std::numeric_limits<double>::infinity());
  std::optional<Slip> first;
  for (const FootStory& foot : story.feet) {
    const auto at = foot.slides();
    if (!at || *at > end || (foot.rolls() && *foot.rolls() < *at)) continue;
    if (!first || *at < first->at) {
      first = Slip{"the " + Spaced(foot.foot()), *at};
    }
  }
  return first;
}

// Lists the most costly rows: "A", "A and B", or "A, B and 3 more".
std::string Rows(const MomentumCause& cause) {
  const double least = kSmallShare * cause.rows.front().second;
  const auto count = static_cast<size_t>(
      std::count_if(cause.rows.begin(), cause.rows.end(),
                    [&](const auto& row) { return row.second >= least; }));
  const size_t said = std::min(count, kMostRows);
  std::string text = cause.rows.front().first;
  for (size_t i = 1; i < said; ++i) {
    text += (i + 1 == count ? " and " : ", ") + cause.rows[i].first;
  }
  return count == said
             ? text
             : text + " and " + std::to_string(count - said) + " more";
}

// Returns at most two sentences about the steps of the robot until its fall.
std::vector<TimedSentence> SaySteps(const RunStory& story, double until) {
  std::vector<std::pair<FootStory::Step, std::string>> steps;
  for (const FootStory& foot : story.feet) {
    for (FootStory::Step step : foot.steps()) {
      if (step.at > until) continue;
      step.has_landed &= step.landing <= until;
      steps.emplace_back(step, foot.foot());
    }
  }
  std::sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) {
    return a.first.at < b.first.at;
  });
  std::vector<TimedSentence> sentences;
  if (steps.empty()) return sentences;
  const auto say = [&](size_t i) {
    sentences.emplace_back(steps[i].first.at,
                           SayStep(steps[i].second, steps[i].first));
  };
  say(0);
  if (steps.size() == 2) {
    say(1);
  } else if (steps.size() > 2) {
    const FootStory::Step& last = steps.back().first;
    sentences.emplace_back(
        steps[1].first.at,
        Format("%.3f s: ", steps[1].first.at) + "the robot takes " +
            std::to_string(steps.size() - 1) + " more steps; " +
            (last.has_landed
                 ? Format("the last one lands at %.3f s.", last.landing)
                 : "the last one does not land."));
  }
  return sentences;
}

TimedSentence SayFirstCause(const MomentumCause& cause, const RunStory& story,
                            const std::optional<double>& fell_at) {
  double from = cause.from, end = cause.from;
  for (const Span& span : story.said.spans()) {
    const bool is_of_it = span.name == cause.rows.front().first &&
                          span.from <= cause.from && span.end >= cause.from;
    if (!is_of_it) continue;
    from = span.from;
    end = span.end;
  }
  std::string text =
      Format("%.3f s: the most costly limit is reached: ", from) + Rows(cause);
  if (fell_at && end >= *fell_at) return {from, text + ", until the fall."};
  text += end > from ? Format(", for %.0f ms.", 1e3 * (end - from)) : ".";
  return {from, text};
}

std::string SayLoss(const RunStory& story,
                    const std::vector<MomentumCause>& causes) {
  const MomentumCost& momentum = story.momentum;
  std::string text =
      Format("%.3f s: the momentum task misses its target", momentum.from()) +
      Format(momentum.peak() < 100 ? " by up to %.3g N" : " by up to %.0f N",
             momentum.peak()) +
      Format(" at %.3f s", momentum.at());
  size_t said = 0;
  for (const MomentumCause& cause : causes) {
    const double share = cause.cost / momentum.cost();
    if (said == kMostCauses || (said > 0 && share < kSmallShare)) break;
    text += (said == 0 ? ", because of " : "; ") + Rows(cause) +
            Format(" (%.0f %%)", 100 * share);
    ++said;
  }
  return text + ".";
}

std::string SayWhatHelps(const std::string& kind, const std::string& first,
                         const RunStory& story, const json& summary) {
  const bool is_pushed = !story.pushes.spans().empty();
  const bool has_stepped =
      std::any_of(story.feet.begin(), story.feet.end(),
                  [](const FootStory& foot) { return !foot.steps().empty(); });
  const std::pair<std::string_view, const char*> kHelp[] = {
      {"cop_limit", has_stepped ? "Longer or earlier steps may have helped"
                                : "A step or larger soles may have helped"},
      {"friction_limit", "More friction may have helped"},
      {"yaw_limit", "More friction or larger soles may have helped"},
      {"normal_force_limit", has_stepped
                                 ? "Longer or earlier steps may have helped"
                                 : "A step or a wider stance may have helped"},
      {"torque_limit", "Stronger motors may have helped"},
      {"joint_limit",
       "Joints with more range, or a posture farther from their stops, would "
       "have helped"},
      {"slip",
       "Rougher ground, or a lower friction coefficient in the controller, "
       "may have helped"}};
  const auto impulse = NumberIn(summary, "impulse_Ns");
  const auto bearable = NumberIn(summary, "lipm_height_Ns");
  if (is_pushed && IsBeyondSteps(summary)) {
    const double with_step = *NumberIn(summary, "step_Ns");
    return "Only a smaller push would have helped: its impulse was " +
           Format("%.1f N s, a pendulum recovers from %.1f N s on these feet, ",
                  *impulse, *bearable) +
           (with_step > 0
                ? Format("and from %.1f N s with one step.", with_step)
                : "and the legs reach no place for a step.");
  }
  std::string text;
  for (const auto& [name, help] : kHelp) {
    if (kind == name) text = help;
  }
  if (text.empty()) text = "A wider limit may have helped: " + first;
  if (is_pushed && impulse && bearable && *impulse > *bearable) {
    text +=
        Format("; so may a smaller push: its impulse was %.1f N s", *impulse) +
        Format(", a pendulum on these feet recovers from %.1f N s", *bearable);
  }
  return text + ".";
}

void SortByTime(std::vector<TimedSentence>* sentences) {
  std::stable_sort(
      sentences->begin(), sentences->end(),
      [](const auto& a, const auto& b) { return a.first < b.first; });
}

// Returns the sentences about the feet in order of time.
std::vector<TimedSentence> Events(const RunStory& story) {
  std::vector<TimedSentence> events;
  for (const FootStory& foot : story.feet) {
    for (const TimedSentence& event : foot.Sentences()) events.push_back(event);
  }
  SortByTime(&events);
  return events;
}

}  // namespace

std::vector<std::string> TellShortStory(const RunStory& story,
                                        const json& summary,
                                        const std::vector<std::string>& notes,
                                        const std::string& ending) {
  const std::vector<MomentumCause> causes = story.momentum.Causes();
  const auto fell_at = NumberIn(summary, "fell_at");
  const double until =
      fell_at.value_or(std::numeric_limits<double>::infinity());
  const auto slip = FindSlip(story, summary);
  const std::vector<Span>& pushes = story.pushes.spans();

  // In order of importance, until they are sorted.
  std::vector<TimedSentence> before;
  if (!pushes.empty()) before.push_back(SayPushes(pushes, summary));
  for (TimedSentence& step : SaySteps(story, until))
    before.push_back(std::move(step));
  if (fell_at && slip) {
    before.emplace_back(
        slip->at, Format("%.3f s: ", slip->at) + slip->foot +
                      " slips on the ground: it has slid by more than 5 mm.");
  }
  if (!causes.empty()) {
    if (!fell_at || !slip) {
      before.push_back(SayFirstCause(causes.front(), story, fell_at));
    }
    before.emplace_back(story.momentum.from(), SayLoss(story, causes));
  }
  std::vector<std::string> after = notes;
  after.push_back(ending);
  // One cannot know more before a suspect setting is changed.
  if (fell_at && SuspectSetting(summary).empty() && !HasMoment(summary) &&
      (slip || !causes.empty())) {
    after.push_back(SayWhatHelps(slip ? "slip" : causes.front().kind,
                                 slip ? "" : causes.front().rows.front().first,
                                 story, summary));
  }
  const size_t length = kStoryLength - (summary.empty() ? 1 : 0);
  if (after.size() > length) after.resize(length);
  const size_t room = length - after.size();
  if (before.size() > room) before.resize(room);
  if (!fell_at) {
    for (const TimedSentence& event : Events(story)) {
      if (before.size() < room) before.push_back(event);
    }
  }
  SortByTime(&before);
  std::vector<std::string> told;
  for (TimedSentence& sentence : before) {
    told.push_back(std::move(sentence.second));
  }
  told.insert(told.end(), std::make_move_iterator(after.begin()),
              std::make_move_iterator(after.end()));
  return told;
}

}  // namespace poise
