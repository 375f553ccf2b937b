// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poise/robot/robot.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/log/run_columns.h"
#include "poise/tools/drawing/robot_picture.h"

namespace poise {

/// A recorded run, read from its folder to draw figures of it.
class RecordedRun {
 public:
  /// Reads the log and summary.json. The robot must outlive this object. Throws
  /// std::invalid_argument if a file cannot be read.
  RecordedRun(const Robot& robot, const std::filesystem::path& folder);

  /// Returns a column of the log by its name in sim/log/columns.h.
  const std::vector<double>& operator[](const std::string& name) const {
    return columns_[name];
  }
  /// Returns the value of a column at a time.
  double At(const std::string& name, double time) const;

  const nlohmann::json& summary() const { return summary_; }
  bool recovered() const {
    return summary_.value("recovered", nlohmann::json()) == true;
  }
  double end() const { return columns_[kTimeColumn].back(); }

  /// Returns the configuration at a time, see Tree.
  Eigen::VectorXd q(double time) const;

  /// Returns the CoM minus its reference along an axis, mm.
  std::vector<double> ComError(char axis) const;

  /// Returns start and end of the push, s, or nothing if there was no push.
  std::optional<std::pair<double, double>> Push() const;

  /// Returns an arrow for each push that acts at a time, see FindPushArrows().
  std::vector<PushArrow> ArrowAt(double time) const;

 private:
  const Robot& robot_;
  RunColumns columns_;
  nlohmann::json summary_;
};

}  // namespace poise
