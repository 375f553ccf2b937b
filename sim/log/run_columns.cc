// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_columns.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "poise/sim/log/columns.h"
#include "poise/sim/log/open_log.h"

namespace poise {

RunColumns::RunColumns(const std::filesystem::path& file,
                       const std::vector<std::string>& names) {
  const std::unique_ptr<LogReader> reader = OpenLog(file);
  LogReader& log = *reader;
  std::vector<std::pair<int, std::vector<double>*>> targets;
  for (const std::string& name : names) {
    const auto column = log.Find(name);
    if (!column) {
      throw std::invalid_argument(file.string() + ": has no column " + name);
    }
    targets.emplace_back(*column, &columns_[name]);
  }
  const auto time = log.Find(kTimeColumn);
  if (!time) {
    throw std::invalid_argument(file.string() + ": has no column " +
                                kTimeColumn);
  }
  if (!columns_.count(kTimeColumn)) {
    targets.emplace_back(*time, &columns_[kTimeColumn]);
  }
  while (log.Next()) {
    for (const auto& [column, values] : targets) {
      values->push_back(log.Number(column));
    }
  }
  if (columns_[kTimeColumn].empty()) {
    throw std::invalid_argument(file.string() + ": has no rows");
  }
}

int RunColumns::RowAt(double time) const {
  const std::vector<double>& times = columns_.at(kTimeColumn);
  // The times of a log are rounded, so the comparison needs a tolerance.
  const auto row = std::lower_bound(times.begin(), times.end(), time - 1e-9);
  return static_cast<int>(
      std::min<std::ptrdiff_t>(row - times.begin(), times.size() - 1));
}

std::vector<std::string> ConfigurationColumns(const RobotModel& robot) {
  std::vector<std::string> names;
  for (const char axis : {'x', 'y', 'z'}) {
    names.push_back(BasePositionColumn(axis));
  }
  for (const char part : {'x', 'y', 'z', 'w'}) {
    names.push_back(BaseQuaternionColumn(part));
  }
  for (const Joint& joint : robot.tree.joints()) {
    names.push_back(PositionColumn(joint.name));
  }
  return names;
}

Eigen::VectorXd ConfigurationAt(const RobotModel& robot,
                                const RunColumns& columns, int row) {
  const std::vector<std::string> names = ConfigurationColumns(robot);
  Eigen::VectorXd q(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) q[i] = columns[names[i]][row];
  return q;
}

}  // namespace poise
