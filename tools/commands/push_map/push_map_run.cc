// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_map_run.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "poise/robot/output_file.h"
#include "poise/sim/push.h"
#include "poise/sim/run.h"
#include "poise/sim/step_yardstick.h"
#include "poise/sim/yardstick.h"
#include "poise/tools/commands/push/record_run.h"
#include "poise/tools/commands/push_map/push_search.h"
#include "poise/tools/commands/report/report_page.h"
#include "poise/tools/viewer/pages.h"

namespace poise {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kPi = 3.14159265358979323846;

// The search stops at this multiple of the yardstick. A robot that recovers
// from such an impulse does not fall at all.
constexpr double kMostOfYardstick = 4;

// A scan begins at this impulse.
constexpr double kScanFrom = 2;  // N s.

Eigen::Vector2d DirectionOf(const PushMapPoint& point) {
  const double angle = point.direction_deg * kPi / 180;
  return {std::cos(angle), std::sin(angle)};
}

Yardstick YardstickOf(const PushMapPlan& plan, const PushMapPoint& point) {
  const Robot& robot = plan.experiment.robot;
  const PushOnRobot push(robot, plan.experiment.scenario.pushes[0]);
  return ComputeYardstick(robot, robot.q_nominal, DirectionOf(point),
                          point.duration, push.body(), push.p_BoQ_B())
      .value();
}

// The state that the threads share.
class Workers {
 public:
  Workers(const PushMapPlan& plan, PushMapFiles* files,
          const std::function<bool(const PushMapProgress&)>& progress);

  bool Work();

 private:
  bool IsDone(const PushMapPoint& point) const;

  void TakePoints();

  // Returns false if the map was stopped before the point was found.
  bool Find(const PushMapPoint& point);

  std::optional<bool> Try(const PushMapPoint& point, double impulse);

  // Fills the columns of a map with steps.
  PushMapValue::Steps StepsAt(const PushMapPoint& point,
                              const ImpulseScan& scan) const;

  // Writes a page with the largest push that the robot recovers from and the
  // next one, from which it does not. Returns false if the map was stopped.
  bool Replay(const PushMapPoint& point, const ImpulseBracket& found);

  void Report(int trials);

  const PushMapPlan& plan_;
  PushMapFiles& files_;
  const std::function<bool(const PushMapProgress&)>& progress_;
  const Clock::time_point start_ = Clock::now();
  std::atomic<std::size_t> next_{0};
  std::atomic<int> done_{0};
  int done_before_ = 0;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  int trials_ = 0;
  std::exception_ptr error_;
};

Workers::Workers(const PushMapPlan& plan, PushMapFiles* files,
                 const std::function<bool(const PushMapProgress&)>& progress)
    : plan_(plan), files_(*files), progress_(progress) {
  for (const PushMapPoint& point : plan.points) {
    if (IsDone(point)) ++done_before_;
  }
  done_ = done_before_;
}

bool Workers::Work() {
  std::vector<std::thread> threads;
  for (int i = 0; i < plan_.threads; ++i) {
    threads.emplace_back([this] { TakePoints(); });
  }
  for (std::thread& thread : threads) thread.join();
  if (error_) std::rethrow_exception(error_);
  return !stopped_;
}

bool Workers::IsDone(const PushMapPoint& point) const {
  return files_.Found(point) &&
         (!plan_.replays || fs::exists(plan_.folder / ReplayFile(point)));
}

void Workers::TakePoints() {
  try {
    for (std::size_t i = next_++; i < plan_.points.size() && !stopped_;
         i = next_++) {
      const PushMapPoint& point = plan_.points[i];
      if (IsDone(point) || !Find(point)) continue;
      ++done_;
      Report(0);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
    stopped_ = true;
  }
}

bool Workers::Find(const PushMapPoint& point) {
  const Yardstick yardstick = YardstickOf(plan_, point);
  const double most = kMostOfYardstick * yardstick.lipm_Ns;
  const auto recovers = [&](double impulse) { return Try(point, impulse); };
  PushMapValue value{0, yardstick.lipm_Ns, yardstick.lipm_height_Ns, {}};
  ImpulseBracket found{};
  if (plan_.scan) {
    const auto scan = ScanImpulses(recovers, kScanFrom, plan_.step, most);
    if (!scan) return false;
    found = {scan->recovered, scan->failed};
    value.steps = StepsAt(point, *scan);
  } else {
    const auto bracket = FindLargestImpulse(recovers, yardstick.lipm_height_Ns,
                                            plan_.step, most);
    if (!bracket) return false;
    found = *bracket;
  }
  value.impulse = found.recovered;
  if (plan_.replays && !Replay(point, found)) return false;
  files_.AddFound(point, value);
  return true;
}

PushMapValue::Steps Workers::StepsAt(const PushMapPoint& point,
                                     const ImpulseScan& scan) const {
  PushMapValue::Steps steps;
  steps.holes = scan.holes;
  const auto bound = ComputeStepYardstick(plan_.experiment.robot,
                                          DirectionOf(point), point.duration);
  steps.step_Ns = bound.value_or(0);
  for (long i = 1;; ++i) {
    const double impulse = static_cast<double>(i) * plan_.step;
    if (impulse > scan.failed || impulse > scan.recovered + plan_.step) break;
    const auto trial = files_.Tried(point, impulse);
    if (!trial) continue;
    if (trial->steps > 0 && steps.first == 0) steps.first = impulse;
    if (impulse == scan.recovered) steps.count = trial->steps;
  }
  return steps;
}

std::optional<bool> Workers::Try(const PushMapPoint& point, double impulse) {
  if (const auto tried = files_.Tried(point, impulse)) return tried->recovered;
  const Experiment experiment = PushExperiment(plan_, point, impulse);
  const RunResult result = Run(experiment.robot, experiment.scenario, {},
                               [this](double) { return !stopped_; });
  if (result.interrupted) return std::nullopt;
  files_.AddTried(
      point, impulse,
      {result.verdict.recovered, static_cast<int>(result.steps.size())});
  Report(1);
  return result.verdict.recovered;
}

bool Workers::Replay(const PushMapPoint& point, const ImpulseBracket& found) {
  const fs::path page = plan_.folder / ReplayFile(point);
  std::vector<fs::path> runs;
  for (const double impulse : {found.recovered, found.failed}) {
    if (!(impulse > 0) || std::isinf(impulse)) continue;
    char name[40];
    std::snprintf(name, sizeof name, "%.2f Ns", impulse);
    const fs::path folder = fs::path(page).replace_extension() / name;
    const RunRecord record =
        RecordRun(PushExperiment(plan_, point, impulse), folder,
                  [this](double) { return !stopped_; });
    if (record.result.interrupted) return false;
    runs.push_back(folder);
  }
  // `runs` is not empty: a search finds at least one of the two impulses.
  WriteReport(runs, page);
  fs::remove_all(fs::path(page).replace_extension());
  return true;
}

void Workers::Report(int trials) {
  const std::lock_guard lock(mutex_);
  trials_ += trials;
  const int points = static_cast<int>(plan_.points.size());
  const int done_now = done_ - done_before_;
  const std::chrono::duration<double> passed = Clock::now() - start_;
  const double left =
      done_now > 0 ? passed.count() / done_now * (points - done_) : -1;
  if (progress_ && !progress_({done_, points, trials_, left})) {
    stopped_ = true;
  }
}

}  // namespace

Experiment PushExperiment(const PushMapPlan& plan, const PushMapPoint& point,
                          double impulse) {
  Experiment experiment = plan.experiment;
  Push& push = experiment.scenario.pushes.at(0);
  push.duration = point.duration;
  const double force = impulse / ProfileIntegral(push);
  SetForce((Eigen::Vector3d() << force * DirectionOf(point), 0).finished(),
           &push);
  return experiment;
}

fs::path ReplayFile(const PushMapPoint& point) {
  char name[80];
  std::snprintf(name, sizeof name, "%05.1fdeg_%gs_", point.direction_deg,
                point.duration);
  return fs::path("replays") / (name + point.tasks + ".html");
}

bool RunPushMap(const PushMapPlan& plan, PushMapFiles* files,
                const std::function<bool(const PushMapProgress&)>& progress) {
  return Workers(plan, files, progress).Work();
}

nlohmann::json MapToJson(const PushMapPlan& plan, const PushMapFiles& files) {
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& [point, value] : files.found()) {
    nlohmann::json row = {{"direction_deg", point.direction_deg},
                          {"duration_s", point.duration},
                          {"tasks", point.tasks},
                          {"impulse_Ns", value.impulse},
                          {"lipm_Ns", value.lipm},
                          {"lipm_height_Ns", value.lipm_height},
                          {"eta", value.impulse / value.lipm}};
    if (value.steps) {
      row["steps"] = value.steps->count;
      row["step_Ns"] = value.steps->step_Ns;
      row["eta_step"] = value.impulse / value.steps->step_Ns;
      row["holes"] = value.steps->holes;
      row["first_step_Ns"] = value.steps->first;
    }
    const fs::path replay = ReplayFile(point);
    if (fs::exists(plan.folder / replay)) row["replay"] = replay.string();
    rows.push_back(std::move(row));
  }
  return {{"format", "poise-map-1"},
          {"robot", plan.experiment.robot.model.name},
          {"scenario", plan.experiment.scenario.name},
          {"step", plan.step},
          {"rows", std::move(rows)}};
}

void WriteMapPage(const PushMapPlan& plan, const PushMapFiles& files) {
  WriteFile(plan.folder / "map.html",
            FillPage(kMapPage, MapToJson(plan, files)));
}

}  // namespace poise
