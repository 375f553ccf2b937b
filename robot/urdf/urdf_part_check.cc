// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_part_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "poise/math/inertia.h"
#include "poise/robot/limits.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Relative tolerance on the triangle inequality of the principal moments of
// inertia. Thin plates are at equality, and files round their moments.
constexpr double kTriangle = 1e-4;
// A radius of gyration, an offset or a prismatic range above this [m] suggests
// a file in millimeters.
constexpr double kLongest = 10;
// A radius of gyration below this [m] is treated as zero.
constexpr double kThinnest = 1e-6;
// An axis shorter than kShortestAxis gives a warning. An axis whose length
// differs from 1 by more than kUnitAxis gives a note.
constexpr double kShortestAxis = 1e-6;
constexpr double kUnitAxis = 1e-4;
// A limit at or above these values is likely a placeholder. Units: N m or N,
// rad/s or m/s, rad or m.
constexpr double kLargestEffort = 1e5;
constexpr double kLargestVelocity = 1e3;
constexpr double kLargestPosition = 1e3;
// A limit above two turns, or a rotation above one turn, is likely in degrees.
// Units: rad.
constexpr double kMostTurns = 4 * M_PI;
constexpr double kTurn = 6.3;

// Reads and checks an effort or velocity limit. A negative effort is rejected,
// because no torque satisfies -effort <= torque <= effort.
double CheckMost(const XMLElement& limit, const char* name, double largest,
                 const Critic& critic) {
  const double value = Number(limit, name, kInfinity);
  const std::string what = std::string(name) + " is " + PrintNumber(value);
  if (value < 0 && name == std::string_view("effort")) {
    critic.Reject(limit, what,
                  "must be zero or positive: give the largest torque or force");
    return kInfinity;
  }
  if (value < 0) {
    critic.Warn(limit, what, "must be positive: is treated as unknown");
    return kInfinity;
  }
  if (value == kInfinity) {
    critic.Warn(limit, what, "is treated as unknown");
  } else if (value >= largest) {
    critic.Warn(limit, what,
                "looks like a placeholder: no motor reaches this value");
  }
  return value;
}

void CheckRange(const XMLElement& limit, const std::string& type,
                JointLimits* limits, const Critic& critic) {
  const bool is_prismatic = type == "prismatic";
  const bool has_lower = limit.Attribute("lower") != nullptr;
  const bool has_upper = limit.Attribute("upper") != nullptr;
  if (type == "continuous") {
    if (has_lower || has_upper) {
      critic.Note(limit, "has lower or upper for a continuous joint",
                  "they are ignored");
    }
    return;
  }
  if (!has_lower && !has_upper) {
    critic.Warn(limit, "has neither lower nor upper",
                "the range is treated as unknown, not as 0");
    return;
  }
  if (!has_lower || !has_upper) {
    critic.Warn(limit, has_lower ? "has no upper" : "has no lower",
                "the URDF default 0 is used");
  }
  const double lower = Number(limit, "lower", 0);
  const double upper = Number(limit, "upper", 0);
  const std::string what =
      "from " + PrintNumber(lower) + " to " + PrintNumber(upper);
  if (!(lower <= upper) || lower == kInfinity || upper == -kInfinity) {
    critic.Warn(limit, what, "is not a range: is treated as unknown");
    return;
  }
  limits->lower = lower;
  limits->upper = upper;
  if (std::isinf(lower) || std::isinf(upper)) {
    critic.Warn(limit, what, "an infinite end is not a limit");
  } else if (lower == upper) {
    critic.Warn(limit, what, "the joint cannot move");
  } else if (std::max(-lower, upper) >= kLargestPosition) {
    critic.Warn(limit, what, "looks like a placeholder");
  } else if (!is_prismatic && std::max(-lower, upper) > kMostTurns) {
    critic.Warn(limit, what, "must be in rad: is it in degrees?");
  } else if (is_prismatic && std::max(-lower, upper) > kLongest) {
    critic.Warn(limit, what, "must be in m: is it in millimeters?");
  }
  if (lower > 0 || upper < 0) {
    critic.Note(limit, what,
                "0 is outside: the joint's rest value is the nearer limit");
  }
}

}  // namespace

void CheckInertial(const XMLElement& link, const Critic& critic) {
  const XMLElement* inertial = link.FirstChildElement("inertial");
  if (inertial == nullptr) return;
  const double mass = Number(*inertial->FirstChildElement("mass"), "value", 0);
  const XMLElement& inertia = *inertial->FirstChildElement("inertia");
  const auto entry = [&](const char* name) { return Number(inertia, name, 0); };
  Eigen::Matrix3d I;
  I << entry("ixx"), entry("ixy"), entry("ixz"),  //
      entry("ixy"), entry("iyy"), entry("iyz"),   //
      entry("ixz"), entry("iyz"), entry("izz");
  if (mass < 0) {
    critic.Reject(*inertial, "mass is " + PrintNumber(mass),
                  "must be zero or positive");
    return;
  }
  CheckOrigin(*inertial, critic);
  const double scale = I.cwiseAbs().maxCoeff();
  if (scale == 0) {
    if (mass == 0) return;
    critic.Note(inertia, "is 0 for a mass of " + PrintNumber(mass) + " kg",
                "the mass is treated as a point: give its inertia");
    return;
  }
  if (mass == 0) {
    critic.Warn(inertia, "has inertia but mass 0",
                "no body is like that: give the link its mass");
  } else if (scale > mass * kLongest * kLongest) {
    critic.Warn(inertia,
                PrintNumber(scale) + " kg m2 for " + PrintNumber(mass) + " kg",
                "which means a body over 10 m wide: is it in millimeters?");
  }
  const Eigen::Vector3d moments = PrincipalMoments(I);
  if (scale < mass * kThinnest * kThinnest) return;  // A point mass.
  if (moments[0] < -kTriangle * moments[2]) {
    critic.Warn(inertia,
                "has the negative principal moment " + PrintNumber(moments[0]),
                "no body has one: the simulated robot may gain energy");
  } else if (moments[0] + moments[1] < (1 - kTriangle) * moments[2]) {
    critic.Warn(inertia,
                "has principal moments " + PrintNumber(moments[0]) + ", " +
                    PrintNumber(moments[1]) + ", " + PrintNumber(moments[2]),
                "none may be larger than the sum of the other two");
  }
}

void CheckOrigin(const XMLElement& element, const Critic& critic) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return;
  if (Vector(*origin, "xyz").cwiseAbs().maxCoeff() > kLongest) {
    critic.Warn(*origin, "xyz is " + Quoted(Text(*origin, "xyz")),
                "which is over 10 m away: is it in millimeters?");
  }
  if (Vector(*origin, "rpy").cwiseAbs().maxCoeff() > kTurn) {
    critic.Warn(*origin, "rpy is " + Quoted(Text(*origin, "rpy")),
                "which is more than one turn: is it in degrees?");
  }
}

void CheckAxis(const XMLElement& joint, const Critic& critic) {
  const XMLElement* axis = joint.FirstChildElement("axis");
  if (axis == nullptr) {
    critic.Note(joint, "has no <axis>", "the URDF default (1, 0, 0) is used");
    return;
  }
  const double length = Vector(*axis, "xyz").stableNorm();
  if (length == 0) {
    critic.Reject(*axis, "xyz is " + Quoted(Text(*axis, "xyz")),
                  "must not be zero");
  } else if (length < kShortestAxis) {
    critic.Warn(*axis, "xyz is " + Quoted(Text(*axis, "xyz")),
                "is normalized, but is too short for a reliable direction");
  } else if (std::abs(length - 1) > kUnitAxis) {
    critic.Note(*axis, "xyz is " + Quoted(Text(*axis, "xyz")),
                "is normalized: the joint's value stays in rad or m");
  }
}

JointLimits CheckLimits(const XMLElement& joint, const Critic& critic) {
  JointLimits limits{-kInfinity, kInfinity, kInfinity, kInfinity};
  const std::string type = Text(joint, "type");
  if (const XMLElement* dynamics = joint.FirstChildElement("dynamics")) {
    limits.damping = Number(*dynamics, "damping", 0);
    limits.friction = Number(*dynamics, "friction", 0);
    for (const auto& [name, value] :
         {std::make_pair("damping", &limits.damping),
          std::make_pair("friction", &limits.friction)}) {
      if (*value >= 0) continue;
      critic.Warn(*dynamics, std::string(name) + " is " + PrintNumber(*value),
                  "must be zero or positive: is treated as 0");
      *value = 0;
    }
  }
  const XMLElement* limit = joint.FirstChildElement("limit");
  if (limit == nullptr) {
    if (type == "continuous") {
      critic.Note(
          joint, "has no <limit>",
          "no limit is known, including effort: control keeps the speed "
          "below " +
              PrintNumber(kAssumedVelocity) + " rad/s");
    } else {
      critic.Reject(joint, "has no <limit>", "must have one");
    }
    return limits;
  }
  limits.effort = CheckMost(*limit, "effort", kLargestEffort, critic);
  limits.velocity = CheckMost(*limit, "velocity", kLargestVelocity, critic);
  if (limits.velocity == 0) {
    critic.Warn(*limit, "velocity is 0", "is treated as unknown");
    limits.velocity = kInfinity;
  }
  if (limits.effort == 0) {
    critic.Warn(*limit, "effort is 0", "the joint has no motor: it is passive");
  }
  if (limits.effort > 0 && limits.friction >= limits.effort) {
    critic.Warn(*joint.FirstChildElement("dynamics"),
                "friction is " + PrintNumber(limits.friction),
                "must be below the effort limit, " +
                    PrintNumber(limits.effort) +
                    ": the motor cannot move this joint");
  }
  CheckRange(*limit, type, &limits, critic);
  return limits;
}

}  // namespace poise
