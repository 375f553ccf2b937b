// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/studies/recorded_run.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "dynamics/kinematics.h"
#include "sim/log/open_log.h"
#include "sim/push.h"

namespace poise {
namespace {

std::vector<std::string> ColumnNames(const RobotModel& robot) {
  std::vector<std::string> names = ConfigurationColumns(robot);
  for (const char* name :
       {"com.x", "com.y", "com.z", "com_ref.x", "com_ref.y", "com_ref.z",
        "cop.x", "cop.y", "push.fx", "push.fy", "push.fz", "base.tilt"}) {
    names.push_back(name);
  }
  return names;
}

}  // namespace

RecordedRun::RecordedRun(const Robot& robot,
                         const std::filesystem::path& folder)
    : robot_(robot), columns_(FindLog(folder), ColumnNames(robot.model)) {
  std::ifstream stream(folder / "summary.json");
  summary_ = nlohmann::json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!summary_.is_object()) {
    throw std::invalid_argument((folder / "summary.json").string() +
                                ": cannot be read as JSON");
  }
}

double RecordedRun::At(const std::string& name, double time) const {
  return columns_[name][columns_.RowAt(time)];
}

Eigen::VectorXd RecordedRun::q(double time) const {
  return ConfigurationAt(robot_.model, columns_, columns_.RowAt(time));
}

std::vector<double> RecordedRun::ComError(const std::string& axis) const {
  std::vector<double> error = columns_["com." + axis];
  const std::vector<double>& reference = columns_["com_ref." + axis];
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = 1e3 * (error[i] - reference[i]);
  }
  return error;
}

std::optional<std::pair<double, double>> RecordedRun::Push() const {
  const std::vector<double>& time = columns_["time"];
  std::optional<std::pair<double, double>> push;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (columns_["push.fx"][i] == 0 && columns_["push.fy"][i] == 0) continue;
    if (!push) push = {time[i], time[i]};
    push->second = time[std::min(i + 1, time.size() - 1)];
  }
  return push;
}

std::optional<PushArrow> RecordedRun::ArrowAt(double time) const {
  const Eigen::Vector3d force(At("push.fx", time), At("push.fy", time),
                              At("push.fz", time));
  if (force.isZero()) return std::nullopt;
  const PushOnRobot push(robot_, {});
  std::vector<Pose> X_WB(robot_.model.tree.num_bodies());
  ComputePoses(robot_.model.tree, q(time), &X_WB);
  return PushArrow{X_WB[push.body()] * push.p_BoQ_B(), force};
}

}  // namespace poise
