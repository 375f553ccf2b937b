// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "sim/log/run_columns.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "sim/log/open_log.h"

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
  const auto time = log.Find("time");
  if (!time) {
    throw std::invalid_argument(file.string() + ": has no column time");
  }
  if (!columns_.count("time")) targets.emplace_back(*time, &columns_["time"]);
  while (log.Next()) {
    for (const auto& [column, values] : targets) {
      values->push_back(log.Number(column));
    }
  }
  if (columns_["time"].empty()) {
    throw std::invalid_argument(file.string() + ": has no rows");
  }
}

int RunColumns::RowAt(double time) const {
  const std::vector<double>& times = columns_.at("time");
  // A time of a log is a sum of ticks: allow for its rounding.
  const auto row = std::lower_bound(times.begin(), times.end(), time - 1e-9);
  return static_cast<int>(
      std::min<std::ptrdiff_t>(row - times.begin(), times.size() - 1));
}

std::vector<std::string> ConfigurationColumns(const RobotModel& robot) {
  std::vector<std::string> names = {"base.x",  "base.y",  "base.z", "base.qx",
                                    "base.qy", "base.qz", "base.qw"};
  for (const Joint& joint : robot.tree.joints()) {
    names.push_back("q." + joint.name);
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
