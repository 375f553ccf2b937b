// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/recorded_run.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "poise/dynamics/kinematics.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/log/open_log.h"
#include "poise/sim/log/run_summary.h"
#include "poise/tools/drawing/push_arrows.h"

namespace poise {
namespace {

std::vector<std::string> ColumnNames(const RobotModel& robot) {
  std::vector<std::string> names = ConfigurationColumns(robot);
  for (const char axis : {'x', 'y', 'z'}) {
    names.push_back(ComColumn(axis));
    names.push_back(ComReferenceColumn(axis));
    names.push_back(PushColumn(axis));
  }
  for (const char axis : {'x', 'y'}) names.push_back(XiColumn(axis));
  names.push_back(CopColumn('x'));
  names.push_back(CopColumn('y'));
  names.push_back(kBaseTiltColumn);
  return names;
}

}  // namespace

RecordedRun::RecordedRun(const Robot& robot,
                         const std::filesystem::path& folder)
    : robot_(robot), columns_(FindLog(folder), ColumnNames(robot.model)) {
  RunSummary read = ReadRunSummary(folder);
  if (read.values.is_null()) {
    throw std::invalid_argument(folder.string() + ": " + read.note);
  }
  summary_ = std::move(read.values);
}

double RecordedRun::At(const std::string& name, double time) const {
  return columns_[name][columns_.RowAt(time)];
}

Eigen::VectorXd RecordedRun::q(double time) const {
  return ConfigurationAt(robot_.model, columns_, columns_.RowAt(time));
}

std::vector<double> RecordedRun::ComError(char axis) const {
  std::vector<double> error = columns_[ComColumn(axis)];
  const std::vector<double>& reference = columns_[ComReferenceColumn(axis)];
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = 1e3 * (error[i] - reference[i]);
  }
  return error;
}

std::optional<std::pair<double, double>> RecordedRun::Push() const {
  const std::vector<double>& time = columns_[kTimeColumn];
  const std::vector<double>& x = columns_[PushColumn('x')];
  const std::vector<double>& y = columns_[PushColumn('y')];
  std::optional<std::pair<double, double>> push;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (x[i] == 0 && y[i] == 0) continue;
    if (!push) push = {time[i], time[i]};
    push->second = time[std::min(i + 1, time.size() - 1)];
  }
  return push;
}

std::vector<PushArrow> RecordedRun::ArrowAt(double time) const {
  std::vector<Pose> X_WB(robot_.model.tree.num_bodies());
  ComputePoses(robot_.model.tree, q(time), &X_WB);
  return FindPushArrows(summary_, At(kTimeColumn, time), X_WB);
}

}  // namespace poise
