// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/save_profile.h"

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "poise/math/rpy.h"
#include "poise/robot/feet/sole_source.h"
#include "poise/robot/output_file.h"
#include "poise/robot/profile/sides.h"

namespace poise {
namespace {

// Prints a number with nine digits. Rounding residuals become 0.
std::string Print(double value) {
  constexpr double kZero = 1e-12;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  text << (std::abs(value) < kZero ? 0 : value);
  return text.str();
}

template <typename Vector>
std::string PrintAll(const Vector& values) {
  std::string text = "[";
  for (int i = 0; i < values.size(); ++i) {
    text += (i > 0 ? ", " : "") + Print(values[i]);
  }
  return text + "]";
}

// Returns a name as YAML writes it, in quotes if YAML needs them.
std::string Name(const std::string& name) {
  YAML::Emitter emitter;
  emitter << name;
  return emitter.c_str();
}

// Writes "NAME: value" on one line. If the name is too long for a YAML key on
// one line (1024 characters), writes two lines.
void WriteEntry(const std::string& indent, const std::string& name,
                double value, std::ostream* stream) {
  constexpr size_t kLongest = 1000;
  const std::string key = Name(name);
  const bool is_long = key.size() > kLongest;
  *stream << indent << (is_long ? "? " : "") << key
          << (is_long ? "\n" + indent : "") << ": " << Print(value) << "\n";
}

void WriteFeet(const Robot& robot, std::ostream* stream) {
  *stream
      << "# The soles. xyz and rpy: the contact frame in a link, m and rad;\n"
         "# z out of the ground, x forward. polygon: the corners in it, m.\n"
         "# from: where the sole was found; remove it if you measured the "
         "sole.\n"
         "feet:\n";
  for (const Foot& foot : robot.feet) {
    const Frame& link = robot.model.tree.frames()[foot.frame];
    const Pose X_FC = link.X_BF.Inverse() * foot.X_BC;
    *stream << "  " << foot.name << ":\n    frame: " << Name(link.name)
            << "\n    xyz: " << PrintAll(X_FC.p)
            << "\n    rpy: " << PrintAll(RpyFromMatrix(X_FC.R))
            << (foot.source ? std::string("\n    from: ") + NameOf(*foot.source)
                            : "")
            << "\n    polygon:\n";
    for (const Eigen::Vector2d& corner : foot.polygon_C) {
      *stream << "      - " << PrintAll(corner) << "\n";
    }
  }
}

// Writes the keys `forward`, `left` and `right` that the profile gave.
void WriteSides(const Sides& sides, std::ostream* stream) {
  if (sides.forward.text.empty() && sides.left.text.empty()) return;
  *stream << "\n# The root link's axis that points forward, links of the feet."
             "\n";
  for (const auto& [key, value] : {std::make_pair("forward", &sides.forward),
                                   std::make_pair("left", &sides.left),
                                   std::make_pair("right", &sides.right)}) {
    if (value->text.empty()) continue;
    *stream << key << ": " << Name(value->text) << "\n";
  }
}

void WritePosture(const Robot& robot, const Profile& profile,
                  std::ostream* stream) {
  const Tree& tree = robot.model.tree;
  const Eigen::Vector3d xyz = robot.q_nominal.head<3>();
  const Eigen::Quaterniond base(Eigen::Vector4d(robot.q_nominal.segment<4>(3)));
  *stream << "\n# The nominal posture: the soles on the ground, their midpoint "
             "at the\n# origin. A joint that is not listed is at 0 or at its "
             "nearest limit.\nposture:\n  found: "
          << Name(profile.base_xyz && !profile.posture_found.empty()
                      ? profile.posture_found
                      : "by standing up, see robot/control/stand.h")
          << "\n  base: {xyz: " << PrintAll(xyz)
          << ", rpy: " << PrintAll(RpyFromMatrix(base.toRotationMatrix()))
          << "}\n  joints:\n";
  for (int j = 0; j < tree.num_joints(); ++j) {
    WriteEntry("    ", tree.joints()[j].name,
               robot.q_nominal[tree.q_start() + j], stream);
  }
}

}  // namespace

void WriteProfile(const Robot& robot, const Profile& profile,
                  std::ostream* stream) {
  *stream << "# A profile of the robot " << Name(robot.model.name) << ".\n\n";
  WriteFeet(robot, stream);
  WriteSides(profile.sides, stream);
  if (robot.can_stand) WritePosture(robot, profile, stream);
  if (!profile.locked.empty()) {
    *stream << "\n# Joints that are fixed, rad or m.\nlocked:\n";
    for (const auto& [name, joint] : profile.locked) {
      WriteEntry("  ", name, joint.value, stream);
    }
  }
  if (profile.mimic != MimicPolicy::kFree) {
    *stream << "\nmimic: "
            << (profile.mimic == MimicPolicy::kLocked ? "locked" : "coupled")
            << "\n";
  }
  if (profile.tasks.IsDefined() && !profile.tasks.IsNull()) {
    YAML::Emitter emitter;
    emitter << YAML::BeginMap << YAML::Key << "tasks" << YAML::Value
            << profile.tasks << YAML::EndMap;
    *stream << "\n# The tasks, by priority level (1 first): docs/tasks.md.\n"
            << emitter.c_str() << "\n";
  }
}

void SaveProfile(const Robot& robot, const Profile& profile,
                 const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::equivalent(file, profile.file, error)) {
    throw std::invalid_argument(
        file.string() + ": is the profile that was read, must be a new file");
  }
  std::ostringstream text;
  WriteProfile(robot, profile, &text);
  WriteFile(file, text.str());
}

}  // namespace poise
