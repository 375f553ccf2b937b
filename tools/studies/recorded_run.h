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

/// A run's folder, as figures look at it.
class RecordedRun {
 public:
  /// Reads the log and summary.json. The robot must outlive it. Throws
  /// std::invalid_argument about what it cannot read.
  RecordedRun(const Robot& robot, const std::filesystem::path& folder);

  /// A column of the log, by its name in sim/log/columns.h.
  const std::vector<double>& operator[](const std::string& name) const {
    return columns_[name];
  }
  /// The same at a time.
  double At(const std::string& name, double time) const;

  const nlohmann::json& summary() const { return summary_; }
  bool recovered() const {
    return summary_.value("recovered", nlohmann::json()) == true;
  }
  double end() const { return columns_[kTimeColumn].back(); }

  /// The configuration at a time, see Tree.
  Eigen::VectorXd q(double time) const;

  /// CoM minus its reference along an axis, mm.
  std::vector<double> ComError(char axis) const;

  /// From when to when somebody pushed; nothing if nobody did.
  std::optional<std::pair<double, double>> Push() const;

  /// Returns an arrow for each push that acts at a time, see FindPushArrows().
  std::vector<PushArrow> ArrowAt(double time) const;

 private:
  const Robot& robot_;
  RunColumns columns_;
  nlohmann::json summary_;
};

}  // namespace poise
