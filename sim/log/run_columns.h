// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Columns of a run's log, whole, by the names that were asked for, as
/// columns.h has them. kTimeColumn is always among them.
class RunColumns {
 public:
  /// Reads columns. Throws std::invalid_argument, naming file and column, if
  /// one is not there, or if the log has no rows.
  RunColumns(const std::filesystem::path& file,
             const std::vector<std::string>& names);

  const std::vector<double>& operator[](const std::string& name) const {
    return columns_.at(name);
  }

  /// The row at which a time was reached, or the last one.
  int RowAt(double time) const;

 private:
  std::map<std::string, std::vector<double>> columns_;
};

/// The names of the columns that hold q, in the order of Tree's q.
std::vector<std::string> ConfigurationColumns(const RobotModel& robot);

/// q, see Tree, as a row of those columns has it.
Eigen::VectorXd ConfigurationAt(const RobotModel& robot,
                                const RunColumns& columns, int row);

}  // namespace poise
