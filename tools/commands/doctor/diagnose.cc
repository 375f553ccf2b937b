// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/diagnose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "poise/dynamics/tick.h"
#include "poise/math/rpy.h"
#include "poise/robot/control/default_stack.h"
#include "poise/robot/control/judge_legs.h"
#include "poise/robot/control/stack.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/control/task_set.h"
#include "poise/robot/feet/forward.h"
#include "poise/robot/feet/no_feet.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/feet/surrounding_rectangle.h"
#include "poise/robot/limits.h"
#include "poise/robot/nominal_tick.h"
#include "poise/robot/profile/massless.h"
#include "poise/robot/profile/save_profile.h"
#include "poise/robot/text_file.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tools/commands/doctor/check_bodies.h"
#include "poise/tools/commands/doctor/check_inertia.h"
#include "poise/tools/commands/doctor/guess_feet.h"
#include "poise/tools/commands/doctor/one_leg.h"
#include "poise/tools/commands/doctor/parity.h"
#include "poise/tools/commands/doctor/strength.h"
#include "poise/tools/commands/doctor/why_falls.h"

namespace poise {
namespace {

using Eigen::VectorXd;

constexpr int kMostJointsToStand = 200;
// With fewer joints a file is a part of a robot, not a biped.
constexpr int kFewestJointsToStand = 4;
constexpr size_t kMostLinksToStand = 1000;
constexpr size_t kMostShapesToStand = 10'000;
// Time of the scenario `stand` that is simulated, s. A robot with weak motors
// sinks slowly; others that fall do so within a few tenths of a second.
constexpr double kSimulated = 1;
constexpr double kSimulatedIfWeak = 5;
// Largest relative difference between the dynamics of Poise and of Bullet.
constexpr double kParity = 1e-9;

// Returns true if the robot is too large for the checks that take more time
// than to read the file.
bool IsLarge(const RobotModel& model) {
  return model.tree.num_joints() > kMostJointsToStand ||
         model.tree.frames().size() > kMostLinksToStand ||
         model.visuals.size() + model.collisions.size() > kMostShapesToStand;
}

// Returns a larger number for a warning that the user should read first. One
// about the robot matters more than one about an element of the file.
int Urgency(const Finding& finding) {
  if (finding.severity != Severity::kWarn) return 0;
  if (finding.what.rfind("has a mass of", 0) == 0) return 3;  // A wrong unit.
  if (finding.what == "does not stand") return 2;
  return finding.line == 0 ? 1 : 0;
}

// Returns the height of the center of mass in the standing posture, m.
double HeightOfMass(const Robot& robot) {
  const Tick tick = NominalTick(robot);
  return tick.p_WG.z();
}

// Returns the first joint whose effort limit is 0.
std::optional<int> FindPassiveJoint(const Robot& robot) {
  for (int j = 0; j < robot.model.tree.num_joints(); ++j) {
    if (robot.model.limits[j].effort == 0) return j;
  }
  return std::nullopt;
}

class Doctor {
 public:
  Doctor(const std::filesystem::path& urdf, const Profile& profile,
         const std::vector<std::filesystem::path>& packages, double longest)
      : urdf_(urdf),
        profile_(profile),
        packages_(packages),
        longest_(longest) {}

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

  void Append(const std::vector<Finding>& findings) {
    diagnosis_.findings.insert(diagnosis_.findings.end(), findings.begin(),
                               findings.end());
  }

  // Sets soles and forward, and compares the legs.
  void DescribeFeet(const Robot& robot);

  void WriteFoundProfile(const Robot& robot);

  // Returns whether the file needs xacro. If it does, adds a finding.
  bool CheckXacro();

  // Throws Refusal if the profile does not match the robot: this is an error of
  // the caller, not a finding about the robot.
  void CheckStanding();

  // Returns the reason why the robot does not stand, or "". Throws
  // std::invalid_argument with the reason if no feet or no posture are found.
  std::string WhyNotStanding();

  // Simulates the robot and returns the reason why it falls, or "" if it stays
  // up. Adds a warning for each weak motor.
  std::string WhyItFalls(const Robot& robot);

  void CheckParity(const Robot& robot);

  const std::filesystem::path urdf_;
  const Profile profile_;
  const std::vector<std::filesystem::path> packages_;
  const double longest_;
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
      diagnosis_.reason =
          "the robot has more than 200 joints, 1000 links or "
          "10000 shapes, and was not tested";
      Add(Severity::kNote, "robot",
          "was not tested for standing or compared with Bullet",
          "because it has more than 200 joints, 1000 links or 10000 shapes");
    } else {
      diagnosis_.was_tested = true;
      CheckStanding();
      if (diagnosis_.soles.empty() && !diagnosis_.has_many_legs) {
        diagnosis_.guessed_feet = GuessFeet(model);
      }
      // MakeModel() gives some bodies a small mass that the file does not have.
      Append(FindWideInertias(*whole));
      if (smallest_eigenvalue_) CheckParity({model, {}, {}});
    }
  }
  std::stable_sort(diagnosis_.findings.begin(), diagnosis_.findings.end(),
                   [](const Finding& a, const Finding& b) {
                     if (a.severity != b.severity) {
                       return a.severity > b.severity;
                     }
                     return Urgency(a) > Urgency(b);
                   });
  return std::move(diagnosis_);
}

void Doctor::Add(Severity severity, std::string where, std::string what,
                 std::string why) {
  diagnosis_.findings.push_back(
      {severity, std::move(where), std::move(what), std::move(why), 0});
}

bool Doctor::CheckXacro() {
  if (urdf_.extension() != ".xacro") return false;
  constexpr size_t kMostMib = 112;  // As UrdfDocument.
  const std::string text = ReadTextFile(urdf_, kMostMib);
  for (const char* sign : {"xacro:", "${", "$("}) {
    if (text.find(sign) == std::string::npos) continue;
    diagnosis_.is_xacro = true;
    Add(Severity::kReject, "", "is xacro, must be URDF",
        "expand it first: xacro FILE > FILE.urdf");
    return true;
  }
  return false;
}

std::optional<RobotModel> Doctor::Load() {
  try {
    if (CheckXacro()) return std::nullopt;
    document_.emplace(urdf_, &diagnosis_.findings, packages_);
    return document_->MakeModel();
  } catch (const Refusal& refusal) {
    // UrdfDocument may have added the reason already.
    if (diagnosis_.worst() != Severity::kReject) {
      diagnosis_.findings.push_back(refusal.finding());
    }
    // An ignored element of xacro may be the cause of another error.
    for (const Finding& finding : diagnosis_.findings) {
      diagnosis_.is_xacro |= finding.what.find("xacro") != std::string::npos ||
                             finding.why.find("xacro") != std::string::npos;
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
  const std::vector<std::string> massless = JointsWithoutMass(whole, profile_);
  // For other robots, MakeRobot() adds the warning.
  if (IsLarge(whole)) {
    if (auto warning = WarnOfMassless(massless)) {
      diagnosis_.findings.push_back(*warning);
    }
  }
  const size_t locked = LockedJoints(whole, profile_).size();
  if (locked > massless.size()) {
    Add(Severity::kNote, "robot",
        "has " + std::to_string(locked - massless.size()) +
            " joints locked by the profile",
        "M, standing and parity are computed with the " +
            std::to_string(whole.tree.num_joints() - locked) + " other joints");
  }
  return MakeModel(*document_, profile_);
}

void Doctor::CheckStanding() {
  try {
    diagnosis_.reason = WhyNotStanding();
  } catch (const Refusal&) {
    throw;
  } catch (const NoFeet& error) {
    diagnosis_.reason = OneLine(error.what());
    if (error.defect() == FeetDefect::kManyLegs) {
      diagnosis_.has_many_legs = true;
      diagnosis_.forward = "+x";  // REP 103.
    } else {
      diagnosis_.remedy = "the efforts of the legs, which are 0, in the file";
    }
  } catch (const std::invalid_argument& error) {
    diagnosis_.reason = OneLine(error.what());
  }
  diagnosis_.stands = diagnosis_.reason.empty();
  if (const auto units = FindWrongUnits(document_->MakeModel())) {
    diagnosis_.findings.push_back(*units);
    diagnosis_.remedy = "the units of the file";
  }
  if (diagnosis_.stands || !diagnosis_.was_tested) return;
  const bool is_part =
      document_->MakeModel().tree.num_joints() < kFewestJointsToStand;
  Add(is_part ? Severity::kNote : Severity::kWarn, "robot", "does not stand",
      diagnosis_.reason);
}

std::string Doctor::WhyNotStanding() {
  Robot robot = MakeRobot(*document_, profile_, &diagnosis_.findings);
  if (profile_.tasks.IsDefined()) {
    Stack stack = MakeDefaultStack(robot, FindTaskLinks(profile_.tasks, robot));
    ApplyTasks(profile_.tasks, profile_.file.string(), &stack);
  }
  DescribeFeet(robot);
  Append(JudgeLegs(robot));
  WriteFoundProfile(robot);
  if (!smallest_eigenvalue_) return "M is singular";
  if (!robot.can_stand) StandUp(&robot, profile_);
  WriteFoundProfile(robot);
  diagnosis_.com_height = HeightOfMass(robot);
  const std::string fall = WhyItFalls(robot);
  if (!fall.empty()) return fall;
  Append(FindOneLegDefects(robot));
  return "";
}

std::string Doctor::WhyItFalls(const Robot& robot) {
  const std::vector<Finding> weakness = FindWeakness(robot);
  Append(weakness);
  std::string where, what;
  if (!weakness.empty()) {
    where = weakness[0].where;
    what = weakness[0].what;
  } else if (const auto joint = FindPassiveJoint(robot)) {
    // A joint without motor may swing until the robot falls, although its
    // torque at rest is negligible.
    where = "joint " + Quoted(robot.model.tree.joints()[*joint].name);
    what = "has no motor (limit 0)";
  }
  // A robot may settle into a posture that its motors hold.
  const std::optional<std::string> fall = WhyFalls(
      robot, profile_, where.empty() ? kSimulated : kSimulatedIfWeak, longest_);
  if (fall && (fall->empty() || where.empty())) return *fall;
  if (!fall && weakness.empty()) {
    Add(Severity::kNote, where.empty() ? "robot" : where,
        where.empty() ? "was not simulated to the end" : what,
        "the simulation took too long to show if the robot falls");
    return "";
  }
  diagnosis_.was_tested = fall.has_value();
  if (fall && where != "robot") diagnosis_.remedy = "the effort of " + where;
  return where + " " + what + ", and " +
         fall.value_or("the simulation took too long to show a fall");
}

void Doctor::DescribeFeet(const Robot& robot) {
  for (const Foot& foot : robot.feet) {
    const TurnedRectangle sole = SurroundingRectangle(foot.polygon_C);
    const Frame& link = robot.model.tree.frames()[foot.frame];
    const Eigen::AngleAxisd turn(sole.angle, Eigen::Vector3d::UnitZ());
    const Pose X_CM{turn.toRotationMatrix(),
                    {sole.center.x(), sole.center.y(), 0}};
    const Pose X_FM = link.X_BF.Inverse() * foot.X_BC * X_CM;
    diagnosis_.soles.push_back({foot.name, link.name, 2 * sole.half_size.x(),
                                2 * sole.half_size.y(), X_FM.p,
                                RpyFromMatrix(X_FM.R),
                                foot.source ? NameOf(*foot.source) : "profile",
                                foot.X_BC.Inverse().p.z()});
  }
  diagnosis_.forward = ForwardAxis(robot);
  Append(CompareLegs(robot));
  Append(FindFarSoles(robot));
}

void Doctor::WriteFoundProfile(const Robot& robot) {
  Profile profile = profile_;
  profile.locked = LockedJoints(document_->MakeModel(), profile_);
  std::ostringstream stream;
  WriteProfile(robot, profile, &stream);
  diagnosis_.profile = stream.str();
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

Diagnosis Diagnose(const std::filesystem::path& urdf, const Profile& profile,
                   const std::vector<std::filesystem::path>& packages,
                   double longest) {
  return Doctor(urdf, profile, packages, longest).Examine();
}

}  // namespace poise
