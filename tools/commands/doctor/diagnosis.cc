// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/diagnosis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

#include "poise/dynamics/tick.h"
#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tools/commands/doctor/check_inertia.h"
#include "poise/tools/commands/doctor/parity.h"
#include "poise/tools/commands/doctor/strength.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr int kMostJointsToStand = 100;
constexpr size_t kMostLinksToStand = 1000;
constexpr size_t kMostShapesToStand = 10'000;
// Largest relative difference between the dynamics of Poise and of Bullet.
constexpr double kParity = 1e-9;

// Returns true if the robot is too large for the checks that take more time
// than to read the file.
bool IsLarge(const RobotModel& model) {
  return model.tree.num_joints() > kMostJointsToStand ||
         model.tree.frames().size() > kMostLinksToStand ||
         model.visuals.size() + model.collisions.size() > kMostShapesToStand;
}

// Returns the height of the center of mass in the standing posture, m.
double HeightOfMass(const Robot& robot) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, robot.q_nominal, VectorXd::Zero(tree.nv()), &tick);
  return tick.p_WG.z();
}

class Doctor {
 public:
  Doctor(const std::filesystem::path& urdf, const Profile& profile,
         const std::vector<std::filesystem::path>& packages)
      : urdf_(urdf), profile_(profile), packages_(packages) {}

  Diagnosis Examine();

 private:
  void Add(Severity severity, std::string where, std::string what,
           std::string why);

  // Returns the robot. If the file is invalid, adds a finding with the reason
  // and returns nothing.
  std::optional<RobotModel> Load();

  void Describe(const RobotModel& model);

  // Returns the robot without the joints that the profile locks. Control, M and
  // parity use this robot.
  RobotModel LockJoints(const RobotModel& whole);

  // Throws Refusal if the profile does not match the robot: this is an error of
  // the caller, not a finding about the robot.
  void CheckStanding();

  void CheckParity(const Robot& robot);

  const std::filesystem::path urdf_;
  const Profile profile_;
  const std::vector<std::filesystem::path> packages_;
  std::optional<UrdfDocument> document_;  // Set by Load().
  Diagnosis diagnosis_;
  std::optional<double> smallest_eigenvalue_;  // See CheckInertia().
};

Diagnosis Doctor::Examine() {
  if (const auto whole = Load()) {
    Describe(*whole);
    const RobotModel model = LockJoints(*whole);
    smallest_eigenvalue_ = CheckInertia(model, &diagnosis_.findings);
    if (IsLarge(model)) {
      Add(Severity::kNote, "robot",
          "was not tested for standing or compared with Bullet",
          "because it has more than 100 joints, 1000 links or 10000 shapes");
    } else {
      CheckStanding();
      if (smallest_eigenvalue_) CheckParity({model, {}, {}});
    }
  }
  std::stable_sort(diagnosis_.findings.begin(), diagnosis_.findings.end(),
                   [](const Finding& a, const Finding& b) {
                     return a.severity > b.severity;
                   });
  return std::move(diagnosis_);
}

void Doctor::Add(Severity severity, std::string where, std::string what,
                 std::string why) {
  diagnosis_.findings.push_back(
      {severity, std::move(where), std::move(what), std::move(why), 0});
}

std::optional<RobotModel> Doctor::Load() {
  try {
    document_.emplace(urdf_, &diagnosis_.findings, packages_);
    return document_->MakeModel();
  } catch (const Refusal& refusal) {
    // UrdfDocument may have added the reason already.
    if (diagnosis_.worst() != Severity::kReject) {
      diagnosis_.findings.push_back(refusal.finding());
    }
  } catch (const std::invalid_argument& error) {
    Add(Severity::kReject, "", error.what(), "");
  }
  return std::nullopt;
}

void Doctor::Describe(const RobotModel& model) {
  const Tree& tree = model.tree;
  diagnosis_.robot = model.name;
  diagnosis_.root = tree.frames()[model.root_frame].name;
  diagnosis_.joints = tree.num_joints();
  diagnosis_.mass = tree.total_mass();
  for (const Inertia& M : tree.inertias()) {
    diagnosis_.bodies.push_back({"", M.mass});
  }
  auto masses = LoadLinkMasses(urdf_);
  for (const Frame& frame : tree.frames()) {
    std::string& link = diagnosis_.bodies[frame.body].link;
    if (link.empty()) link = frame.name;
    diagnosis_.links.push_back({frame.name, masses[frame.name]});
  }
}

RobotModel Doctor::LockJoints(const RobotModel& whole) {
  const size_t locked = LockedJoints(whole, profile_).size();
  if (locked == 0) return whole;
  Add(Severity::kNote, "robot",
      "has " + std::to_string(locked) + " joints locked by the profile",
      "M, standing and parity are computed with the " +
          std::to_string(whole.tree.num_joints() - locked) + " other joints");
  return MakeModel(*document_, profile_);
}

void Doctor::CheckStanding() {
  std::string reason = "because M is singular";
  try {
    Robot robot = MakeRobot(*document_, profile_, &diagnosis_.findings);
    if (profile_.tasks.IsDefined()) {
      Stack stack =
          MakeDefaultStack(robot, FindTaskLinks(profile_.tasks, robot));
      ApplyTasks(profile_.tasks, profile_.file.string(), &stack);
    }
    for (const Foot& foot : robot.feet) {
      Eigen::AlignedBox2d sole;
      for (const Eigen::Vector2d& corner : foot.polygon_C) sole.extend(corner);
      diagnosis_.soles.push_back({foot.name,
                                  robot.model.tree.frames()[foot.frame].name,
                                  sole.sizes().x(), sole.sizes().y()});
    }
    if (smallest_eigenvalue_) {
      if (!robot.can_stand) StandUp(&robot);
      for (const Finding& finding : FindWeakness(robot)) {
        diagnosis_.findings.push_back(finding);
      }
      diagnosis_.com_height = HeightOfMass(robot);
      return;
    }
  } catch (const Refusal&) {
    throw;
  } catch (const std::invalid_argument& error) {
    reason = OneLine(error.what());
  }
  Add(Severity::kNote, "robot", "does not stand", reason);
}

void Doctor::CheckParity(const Robot& robot) {
  try {
    diagnosis_.parity = CompareWithBullet(robot, robot).worst();
  } catch (const std::invalid_argument& error) {
    Add(Severity::kNote, "robot", "was not compared with Bullet",
        OneLine(error.what()));
    return;
  }
  // The M of the plant is the inverse of measured accelerations. The inversion
  // amplifies rounding errors by 1 / smallest_eigenvalue_.
  const double rounding = std::numeric_limits<double>::epsilon() *
                          robot.model.tree.nv() / *smallest_eigenvalue_;
  // The comparison is false for NaN.
  if (*diagnosis_.parity <= std::max(kParity, rounding)) return;
  Add(Severity::kWarn, "robot",
      "differs from its Bullet plant by " + PrintNumber(*diagnosis_.parity),
      "relative error: simulation and controller do not agree");
}

}  // namespace

Severity Diagnosis::worst() const {
  Severity worst = Severity::kNote;
  for (const Finding& finding : findings) {
    worst = std::max(worst, finding.severity);
  }
  return worst;
}

Diagnosis Diagnose(const std::filesystem::path& urdf, const Profile& profile,
                   const std::vector<std::filesystem::path>& packages) {
  return Doctor(urdf, profile, packages).Examine();
}

}  // namespace poise
