// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "poise/robot/control/stack.h"
#include "poise/robot/control/task.h"
#include "poise/robot/finding.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/push.h"

namespace poise {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity and no NaN.
Json Number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

template <typename Vector>
Json Numbers(const Vector& values) {
  Json list = Json::array();
  for (const double x : values) list.push_back(Number(x));
  return list;
}

// Returns the link of a push, also if the push does not name one.
std::string LinkName(const Robot& robot, const PushOnRobot& push) {
  if (!push.push().link.empty()) return push.push().link;
  for (const Frame& frame : robot.model.tree.frames()) {
    if (frame.body == push.body()) return frame.name;
  }
  return "";
}

// Returns the push that the keys of a single push describe: the largest push,
// or the first push if all impulses are zero.
const Push& MainPush(const Scenario& scenario) {
  const Push* largest = LargestPush(scenario.pushes, scenario.duration);
  return largest != nullptr ? *largest : scenario.pushes[0];
}

Json PushesToJson(const Robot& robot, const Scenario& scenario) {
  Json list = Json::array();
  for (const Push& push : scenario.pushes) {
    const PushOnRobot aimed(robot, push);
    Json entry;
    entry["link"] = LinkName(robot, aimed);
    entry["body"] = aimed.body();
    entry["point"] = Numbers(aimed.p_BoQ_B());
    entry["force"] = Numbers(aimed.force());
    entry["moment"] = Numbers(push.moment);
    entry["frame"] = push.frame == PushFrame::kWorld ? "world" : "body";
    entry["at"] = push.start;
    entry["duration"] = push.duration;
    entry["shape"] = NameOf(push.profile);
    entry["impulse_Ns"] = ImpulseOf(push, scenario.duration);
    // The fraction of the bound that the force was computed from.
    entry["impulse_fraction"] =
        push.impulse_fraction ? Json(*push.impulse_fraction) : Json(nullptr);
    list.push_back(std::move(entry));
  }
  return list;
}

Json StepsToJson(const Robot& robot, const RunResult& result) {
  Json list = Json::array();
  for (const TakenStep& step : result.steps) {
    Json entry;
    entry["foot"] = robot.feet[step.foot].name;
    entry["at"] = step.at;
    entry["commanded"] = step.is_commanded;
    entry["planned"] = Numbers(step.planned);
    const bool landed = step.has_landed;
    entry["landed"] = landed ? Numbers(step.landed) : Json(nullptr);
    entry["swing_s"] = landed ? Json(step.swing_time) : Json(nullptr);
    entry["touchdown_mps"] =
        landed ? Json(step.touchdown_speed) : Json(nullptr);
    entry["impact_Ns"] = landed ? Json(step.impact_Ns) : Json(nullptr);
    entry["slide_m"] = landed ? Json(step.slide) : Json(nullptr);
    list.push_back(std::move(entry));
  }
  return list;
}

Json Times(const TickTimes& us) {
  return {{"median", us.median},
          {"p99", us.p99},
          {"p999", us.p999},
          {"max", us.max}};
}

Json Rows(const std::vector<StackRow>& rows) {
  Json object = Json::object();
  for (const StackRow& row : rows) {
    object[LogName(row.row.name)] = {{"unit", row.row.unit},
                                     {"phrase", row.row.phrase},
                                     {"kind", RowKindName(row.row.kind)},
                                     {"task", row.task}};
  }
  return object;
}

// Returns a line of the table: a label, then the text that printf() formats.
__attribute__((format(printf, 2, 3))) std::string Line(const char* label,
                                                       const char* format,
                                                       ...) {
  char text[160], line[200];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof(text), format, arguments);
  va_end(arguments);
  std::snprintf(line, sizeof(line), "  %-22s %s\n", label, text);
  return line;
}

std::string TimesLine(const char* label, const TickTimes& us) {
  return Line(label, "%.0f us (99 %%: %.0f, 99.9 %%: %.0f, max %.0f)",
              us.median, us.p99, us.p999, us.max);
}

// Returns the moment of a push without a force as a line of the table.
std::string MomentLine(const Robot& robot, const Push& push) {
  return Line("push", "a moment of up to %.0f N m for %.3f s on %s",
              push.moment.norm(), push.duration,
              OneLine(LinkName(robot, PushOnRobot(robot, push))).c_str());
}

// Returns one push as a line of the table. Several pushes need their start
// times.
std::string PushLine(const Robot& robot, const Push& push, double until,
                     bool with_start) {
  constexpr double kDegree = M_PI / 180;
  const char* shape = "";
  if (push.profile == PushProfile::kHalfSine) shape = "half sine, peak ";
  if (push.profile == PushProfile::kImpulse) shape = "in one step, as much as ";
  std::string start =
      with_start ? ", from " + PrintNumber(push.start) + " s" : "";
  if (push.impulse_fraction) {
    start += ", " + PrintNumber(*push.impulse_fraction) + " of the bound";
  }
  return Line("push", "%.2f N s over %.3f s: %s%.0f N at %.0f deg%s on %s%s",
              ImpulseOf(push, until), push.duration, shape, push.force.norm(),
              std::atan2(push.force.y(), push.force.x()) / kDegree,
              push.frame == PushFrame::kLink ? " in the link's axes" : "",
              OneLine(LinkName(robot, PushOnRobot(robot, push))).c_str(),
              start.c_str());
}

std::string PushLines(const Robot& robot, const Scenario& scenario) {
  constexpr int kMostLines = 5;
  std::vector<const Push*> shown;
  bool is_late = !scenario.pushes.empty();
  bool is_zero = is_late;
  for (const Push& push : scenario.pushes) {
    is_late = is_late && push.start >= scenario.duration;
    is_zero = is_zero && IsZero(push);
    const bool has_begun = push.start < scenario.duration;
    if (has_begun && !IsZero(push)) shown.push_back(&push);
  }
  if (is_late) return Line("push", "%s", "none before the end of the run");
  if (is_zero) return Line("push", "%s", "none: all forces or durations are 0");
  const int count = static_cast<int>(shown.size());
  std::string lines;
  for (int i = 0; i < std::min(count, kMostLines); ++i) {
    lines += shown[i]->force.isZero(0)
                 ? MomentLine(robot, *shown[i])
                 : PushLine(robot, *shown[i], scenario.duration, count > 1);
  }
  if (count > kMostLines) {
    lines += Line("push", "and %d more", count - kMostLines);
  }
  return lines;
}

// Returns the steps, and what became of the commanded ones, as lines of the
// table.
std::string StepLines(const Robot& robot, const RunResult& result) {
  constexpr int kMostLines = 6;
  std::string lines;
  const int count = static_cast<int>(result.steps.size());
  for (int i = 0; i < std::min(count, kMostLines); ++i) {
    const TakenStep& step = result.steps[i];
    const std::string foot = OneLine(robot.feet[step.foot].name);
    if (!step.has_landed) {
      lines += Line("step", "%s at %.3f s, not landed", foot.c_str(), step.at);
      continue;
    }
    lines += Line("step", "%s at %.3f s, landed at (%.2f, %.2f) m after %.2f s",
                  foot.c_str(), step.at, step.landed.x(), step.landed.y(),
                  step.swing_time);
  }
  if (count > kMostLines)
    lines += Line("step", "and %d more", count - kMostLines);
  if (result.commanded_done) {
    lines += Line("commanded motion", "%s",
                  *result.commanded_done ? "done" : "not all done");
  }
  for (const std::string& missed : result.not_done) {
    lines += Line("not done", "%s", missed.c_str());
  }
  return lines;
}

// Returns the outcome, the first line of the table.
std::string OutcomeLine(const Scenario& scenario, const RunResult& result) {
  const Verdict& verdict = result.verdict;
  char text[120];
  if (verdict.fell_at) {
    std::snprintf(text, sizeof(text), "fell at %.3f s: ", *verdict.fell_at);
    return text + FellBy(result) + (result.interrupted ? " (interrupted)" : "");
  }
  if (result.interrupted) return "interrupted";
  if (verdict.recovered) {
    return result.commanded_done.value_or(true)
               ? "recovered"
               : "recovered, but the commanded motion did not happen";
  }
  const auto after = TooShortAfterPushes(scenario, result);
  if (!after) return "did not come back";
  std::snprintf(text, sizeof(text),
                "not recovered: the run ends %.3g s %s the end of the push, "
                "recovery needs %.3g s after it",
                std::abs(*after), *after < 0 ? "before" : "after", Judge::kEnd);
  return text;
}

}  // namespace

Json ToJson(const Robot& robot, const Scenario& scenario,
            const RunResult& result, std::optional<double> step_Ns) {
  const Verdict& verdict = result.verdict;
  const double simulated = result.duration;
  Json json;
  json["scenario"] = scenario.name;
  json["robot"] = robot.model.name;
  json["seed"] = scenario.seed;
  json["plant"] = scenario.plant_kind;
  json["control_dt"] = scenario.control.dt;
  json["plant_dt"] = scenario.plant.dt;
  json["duration"] = simulated;
  json["push_duration"] = result.push_duration;
  json["sensor_noise"] = scenario.sensors.noise;
  if (!scenario.pushes.empty()) {
    const PushOnRobot push(robot, MainPush(scenario));
    json["push_link"] = LinkName(robot, push);
    json["push_body"] = push.body();
    json["push_point"] = Numbers(push.p_BoQ_B());
  }
  json["pushes"] = PushesToJson(robot, scenario);
  const ControlSettings& control = scenario.control;
  json["tasks"] = {{"set", control.tasks},
                   {"with", control.with},
                   {"without", control.without}};
  // A robot that stood when the run was interrupted might have fallen later.
  const bool is_judged = !result.interrupted || verdict.fell_at;
  json["recovered"] = is_judged ? Json(verdict.recovered) : Json(nullptr);
  json["fell_at"] = verdict.fell_at ? Json(*verdict.fell_at) : Json(nullptr);
  json["fell_by"] = FellBy(result);
  json["interrupted"] = result.interrupted;
  json["time_after_push"] = Number(TimeAfterPushes(scenario.pushes, simulated));
  json["com_error_peak"] = Numbers(verdict.com_error_peak);
  json["com_error_final"] = Numbers(verdict.com_error_final);
  json["cop_peak"] = Numbers(verdict.cop_peak);
  json["foot_tilt_peak"] = Number(verdict.foot_tilt_peak);
  json["foot_slide_peak"] = Number(verdict.foot_slide_peak);
  json["joint_limit_violation_peak"] =
      Number(result.joint_limit_violation_peak);
  json["torque_limit_violation_peak"] =
      Number(result.torque_limit_violation_peak);
  json["self_contact_ticks"] = result.self_contact_ticks;
  json["impulse_Ns"] = result.impulse_Ns;
  json["lipm_Ns"] =
      result.yardstick ? Number(result.yardstick->lipm_Ns) : Json(nullptr);
  json["lipm_height_Ns"] = result.yardstick
                               ? Number(result.yardstick->lipm_height_Ns)
                               : Json(nullptr);
  json["step_Ns"] = step_Ns ? Number(*step_Ns) : Json(nullptr);
  json["steps"] = StepsToJson(robot, result);
  json["commanded_done"] =
      result.commanded_done ? Json(*result.commanded_done) : Json(nullptr);
  json["not_done"] = result.not_done;
  json["ticks"] = result.ticks;
  json["tick_us"] = Times(result.tick_us);
  json["hqp"] = {{"iterations_max", result.iterations_max},
                 {"failures", result.failures},
                 {"modelled_us", Times(result.modelled_us)},
                 {"certificate_max", Number(result.certificate_max)},
                 {"budget_us", Number(scenario.control.budget_us)},
                 {"budget_clock", scenario.control.budget_clock}};
  json["gap_max"] = Number(result.gap_max);
  json["real_time_factor"] = Number(simulated / result.wall_seconds);
  json["log_sha256"] = result.log_sha256;
  json["rows"] = Rows(result.rows);
  return json;
}

std::string ToTable(const Robot& robot, const Scenario& scenario,
                    const RunResult& result, std::optional<double> step_Ns) {
  const Verdict& verdict = result.verdict;
  const Eigen::Vector3d peak = 1e3 * verdict.com_error_peak;
  const Eigen::Vector3d last = 1e3 * verdict.com_error_final;
  std::string table =
      scenario.name + ": " + OutcomeLine(scenario, result) + "\n\n";
  table +=
      Line("robot", "%s, %d joints, %.1f kg", OneLine(robot.model.name).c_str(),
           robot.model.tree.num_joints(), robot.model.tree.total_mass());
  table +=
      Line("simulated", "%.2f s in %s, control at %.0f Hz", result.duration,
           scenario.plant_kind.c_str(), 1 / scenario.control.dt);
  table += PushLines(robot, scenario);
  if (result.yardstick) {
    table +=
        Line("pendulum bound", "%.2f N s at its CoM, %.2f N s at push height",
             result.yardstick->lipm_Ns, result.yardstick->lipm_height_Ns);
  }
  if (step_Ns) {
    table += *step_Ns > 0
                 ? Line("with one step", "%.2f N s at its CoM", *step_Ns)
                 : Line("with one step", "none: the legs reach no place");
  }
  table += StepLines(robot, result);
  table += Line("CoM error, peak", "%6.1f %6.1f %6.1f mm", peak.x(), peak.y(),
                peak.z());
  table += Line("CoM error, at the end", "%6.2f %6.2f %6.2f mm", last.x(),
                last.y(), last.z());
  table += Line("CoP, peak", "%6.1f %6.1f mm from mid-feet",
                1e3 * verdict.cop_peak.x(), 1e3 * verdict.cop_peak.y());
  table += Line("feet, peak", "tilt %.4f rad, slide %.2f mm",
                verdict.foot_tilt_peak, 1e3 * verdict.foot_slide_peak);
  table += Line("beyond limits, peak", "joints %.2g rad, torques %.2g N m",
                result.joint_limit_violation_peak,
                result.torque_limit_violation_peak);
  if (result.self_contact_ticks > 0) {
    table += Line("self-contact", "in %d ticks", result.self_contact_ticks);
  }
  table += Line("ticks", "%ld; %d of them not solved to the last level",
                result.ticks, result.failures);
  table += TimesLine("time per tick", result.tick_us);
  table += TimesLine("predicted per solve", result.modelled_us);
  table +=
      Line("speed", "%.1f x real time", result.duration / result.wall_seconds);
  return table;
}

}  // namespace poise
