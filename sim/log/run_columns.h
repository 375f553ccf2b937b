// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "poise/robot/robot.h"

namespace poise {

/// Whole columns of a run's log in memory, by the names that the caller chose
/// from columns.h. kTimeColumn is always included.
class RunColumns {
 public:
  /// Reads columns. Throws std::invalid_argument with the file's name if a
  /// column is missing, which it names, or if the log has no rows.
  RunColumns(const std::filesystem::path& file,
             const std::vector<std::string>& names);

  const std::vector<double>& operator[](const std::string& name) const {
    return columns_.at(name);
  }

  /// Returns the first row at or after a time, s, or the last row.
  int RowAt(double time) const;

 private:
  std::map<std::string, std::vector<double>> columns_;
};

/// Returns the names of the columns that hold q, in the order of Tree's q.
std::vector<std::string> ConfigurationColumns(const RobotModel& robot);

/// Returns q, see Tree, of a row. pre: `columns` has ConfigurationColumns().
Eigen::VectorXd ConfigurationAt(const RobotModel& robot,
                                const RunColumns& columns, int row);

}  // namespace poise
