// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/diagnosis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

#include "dynamics/tick.h"
#include "robot/control/command.h"
#include "robot/control/controller.h"
#include "robot/control/default_stack.h"
#include "robot/control/measurement.h"
#include "robot/control/stack.h"
#include "robot/control/stand.h"
#include "robot/control/task_set.h"
#include "robot/control/tick_report.h"
#include "robot/limits.h"
#include "robot/urdf.h"
#include "tools/parity.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostJointsForInertia = 500;
constexpr int kMostJointsToStand = 100;
constexpr size_t kMostLinksToStand = 1000;
constexpr size_t kMostShapesToStand = 10'000;
// Of M with a unit diagonal: the smallest eigenvalue that is not rounding.
constexpr double kSingular = 1e-13;
// Where its inverse loses half the digits.
constexpr double kIllConditioned = 1e-8;
// Two dynamics of one robot agree to this, relative.
constexpr double kParity = 1e-9;

// Too large for what takes more time than reading it.
bool IsLarge(const RobotModel& model) {
  return model.tree.num_joints() > kMostJointsToStand ||
         model.tree.frames().size() > kMostLinksToStand ||
         model.visuals.size() + model.collisions.size() > kMostShapesToStand;
}

class Doctor {
 public:
  Doctor(const std::filesystem::path& urdf, const Profile& profile)
      : urdf_(urdf), profile_(profile) {}

  Diagnosis Examine() {
    if (const auto whole = Load()) {
      Describe(*whole);
      const RobotModel model = LockJoints(*whole);
      CheckInertia(model);
      if (IsLarge(model)) {
        Add(Severity::kNote, "robot",
            "was not stood up, nor compared with Bullet",
            "as it has over 100 joints, 1000 links or 10000 shapes");
      } else {
        CheckStanding();
        if (is_regular_) CheckParity({model, {}, {}});
      }
    }
    std::stable_sort(diagnosis_.findings.begin(), diagnosis_.findings.end(),
                     [](const Finding& a, const Finding& b) {
                       return a.severity > b.severity;
                     });
    return std::move(diagnosis_);
  }

 private:
  void Add(Severity severity, std::string where, std::string what,
           std::string why) {
    diagnosis_.findings.push_back(
        {severity, std::move(where), std::move(what), std::move(why), 0});
  }

  // The robot, or a finding that says why there is none.
  std::optional<RobotModel> Load() {
    try {
      return LoadUrdf(urdf_, {}, &diagnosis_.findings);
    } catch (const Refusal& refusal) {
      // What LoadUrdf() found it has told already.
      if (diagnosis_.worst() != Severity::kReject) {
        diagnosis_.findings.push_back(refusal.finding());
      }
    } catch (const std::invalid_argument& error) {
      Add(Severity::kReject, "", error.what(), "");
    }
    return std::nullopt;
  }

  void Describe(const RobotModel& model) {
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

  // What the profile leaves of the robot for control, and for M and parity.
  RobotModel LockJoints(const RobotModel& whole) {
    const size_t locked = LockedJoints(whole, profile_).size();
    if (locked == 0) return whole;
    Add(Severity::kNote, "robot",
        "has " + std::to_string(locked) + " joints locked by the profile",
        "M, standing and parity are of the " +
            std::to_string(whole.tree.num_joints() - locked) + " others");
    return LoadModel(urdf_, profile_);
  }

  // What coordinate i of v moves.
  std::string Coordinate(const RobotModel& model, int i) const {
    const int j = i - model.tree.v_start();
    if (j < 0) return "base " + Quoted(diagnosis_.root);
    return "joint " + Quoted(model.tree.joints()[j].name);
  }

  void CheckInertia(const RobotModel& model) {
    const Tree& tree = model.tree;
    if (tree.num_joints() > kMostJointsForInertia) {
      Add(Severity::kNote, "robot",
          "has " + std::to_string(tree.num_joints()) + " joints",
          "M was not computed, as there are more than 500");
      return;
    }
    Tick tick(tree, {});
    ComputeTick(tree, RestConfiguration(model), VectorXd::Zero(tree.nv()),
                &tick);
    constexpr double kTooLarge = 1e20;  // Against which 1 is rounding.
    if (!tick.M.allFinite() || tick.M.maxCoeff() > kTooLarge) {
      Add(Severity::kWarn, "robot", "M is too large or not finite",
          "numbers this large cannot be computed with");
      return;
    }
    const VectorXd diagonal = tick.M.diagonal();
    for (int i = 0; i < tree.nv(); ++i) {
      if (diagonal[i] > 0) continue;
      const bool nothing = diagonal[i] == 0;
      Add(Severity::kWarn, Coordinate(model, i),
          nothing ? "moves no mass" : "has negative inertia",
          "M is singular or worse: no acceleration can be computed");
      return;
    }
    const VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
        scale.asDiagonal() * tick.M * scale.asDiagonal());
    const double smallest = eigen.eigenvalues()[0];
    int i = 0;
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&i);
    if (smallest < -kSingular * tree.nv()) {
      Add(Severity::kWarn, Coordinate(model, i), "makes M indefinite",
          "kinetic energy can be negative: an inertia is unphysical");
    } else if (smallest < kSingular * tree.nv()) {
      Add(Severity::kWarn, Coordinate(model, i), "makes M singular",
          "others move the same mass: no acceleration can be computed");
    } else {
      is_regular_ = true;
      smallest_eigenvalue_ = smallest;
      if (smallest < kIllConditioned) {
        Add(Severity::kNote, Coordinate(model, i),
            "makes M ill-conditioned, by " + PrintNumber(1 / smallest),
            "accelerations lose as many digits");
      }
    }
  }

  // A profile that does not fit is the caller's mistake, not the robot's.
  void CheckStanding() {
    std::string reason = "as M is singular";
    try {
      Robot robot = LoadRobot(urdf_, profile_, &diagnosis_.findings);
      if (profile_.tasks.IsDefined()) {
        Stack stack = MakeDefaultStack(robot, {});
        ApplyTasks(profile_.tasks, profile_.file.string(), &stack);
      }
      for (const Foot& foot : robot.feet) {
        diagnosis_.soles.push_back(
            {foot.name, robot.model.tree.frames()[foot.frame].name,
             2 * foot.half_size.x(), 2 * foot.half_size.y()});
      }
      if (is_regular_) {
        if (!robot.can_stand) StandUp(&robot);
        CheckStrength(robot);
        return;
      }
    } catch (const Refusal&) {
      throw;
    } catch (const std::invalid_argument& error) {
      reason = OneLine(error.what());
    }
    Add(Severity::kNote, "robot", "does not stand", reason);
  }

  // Whether there are contact forces with which the motors hold the robot up
  // where it stands: torque limits come after the posture, and one that is
  // missed shows what the posture takes.
  void CheckStrength(const Robot& robot) {
    constexpr double kHeld = 1e-3;    // rad/s² or m/s²: what rounding leaves.
    constexpr double kMissed = 1e-6;  // Of the limit.
    const Tree& tree = robot.model.tree;
    Controller controller(robot);
    Stack& stack = controller.stack();
    const int limits = stack.Find("torque_limits").value();
    const int last = stack.settings(stack.Find("posture").value()).rank + 2;
    if (!stack.SetRank("torque_limits", last - 1) ||
        !stack.SetRank("force_regularizer", last)) {
      throw std::logic_error("the stack has no room for two more ranks");
    }
    const State rest{0, robot.q_nominal, VectorXd::Zero(tree.nv())};
    Command command{VectorXd::Zero(tree.num_joints())};
    controller.Start(rest);
    controller.Update(rest, &command);
    diagnosis_.com_height = controller.tick().p_WG.z();
    const TickReport& report = controller.report();
    for (const ActiveRow& row : report.active) {
      if (row.task != limits || row.slack <= kMissed) continue;
      const double effort = robot.model.limits[row.row].effort;
      Add(Severity::kWarn, Coordinate(robot.model, tree.v_start() + row.row),
          "needs " + PrintNumber(effort * (1 + row.slack)) + " of " +
              PrintNumber(effort) +
              (tree.joints()[row.row].type == JointType::kPrismatic ? " N"
                                                                    : " N m") +
              " to stand",
          "its posture cannot be held");
    }
    if (!(report.y.head(tree.nv()).lpNorm<Eigen::Infinity>() <= kHeld)) {
      Add(Severity::kWarn, "robot", "cannot hold its posture",
          "not with the contact forces that its soles can give");
    }
  }

  void CheckParity(const Robot& robot) {
    try {
      diagnosis_.parity = CompareWithBullet(robot, robot).worst();
    } catch (const std::invalid_argument& error) {
      Add(Severity::kNote, "robot", "was not compared with Bullet",
          OneLine(error.what()));
      return;
    }
    // M comes from the plant by an inversion, which costs digits.
    const double rounding = std::numeric_limits<double>::epsilon() *
                            robot.model.tree.nv() / smallest_eigenvalue_;
    if (*diagnosis_.parity <= std::max(kParity, rounding)) return;  // Not NaN.
    Add(Severity::kWarn, "robot",
        "differs from its Bullet plant by " + PrintNumber(*diagnosis_.parity),
        "relative: simulation and control do not agree");
  }

  const std::filesystem::path urdf_;
  const Profile profile_;
  Diagnosis diagnosis_;
  bool is_regular_ = false;         // M can be inverted.
  double smallest_eigenvalue_ = 0;  // Of M with a unit diagonal.
};

}  // namespace

Severity Diagnosis::worst() const {
  Severity worst = Severity::kNote;
  for (const Finding& finding : findings) {
    worst = std::max(worst, finding.severity);
  }
  return worst;
}

Diagnosis Diagnose(const std::filesystem::path& urdf, const Profile& profile) {
  return Doctor(urdf, profile).Examine();
}

}  // namespace poise
