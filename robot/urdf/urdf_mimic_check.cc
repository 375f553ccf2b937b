// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_mimic_check.h"

#include <cmath>
#include <unordered_map>

#include "poise/robot/finding.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

void CheckSource(const XMLElement& joint, const Elements& joints,
                 const Critic& critic) {
  const XMLElement* mimic = joint.FirstChildElement("mimic");
  if (mimic == nullptr) return;
  const std::string source = Text(*mimic, "joint");
  const std::string what = "mimics " + Quoted(source);
  if (source == Text(joint, "name")) {
    critic.Reject(joint, what, "must be another joint");
  } else if (joints.count(source) == 0) {
    critic.Reject(joint, what, "there is no such joint");
  } else if (!IsMoving(*joints.at(source))) {
    critic.Warn(joint, what, "which is fixed: the joint moves independently");
  } else {
    critic.Note(
        joint, what,
        "it moves independently unless the profile couples or locks it");
  }
}

// Rejects a chain of mimic joints that forms a cycle.
void CheckCycles(const std::vector<std::string>& names, const Elements& joints,
                 const Critic& critic) {
  std::unordered_map<std::string, int> visit;
  for (size_t i = 0; i < names.size(); ++i) {
    std::string name = names[i];
    while (joints.count(name) != 0 && visit.count(name) == 0) {
      visit[name] = static_cast<int>(i);
      const XMLElement* mimic = joints.at(name)->FirstChildElement("mimic");
      const std::string source = mimic != nullptr ? Text(*mimic, "joint") : "";
      if (source == name) break;  // Rejected already.
      const auto seen = visit.find(source);
      if (seen != visit.end() && seen->second == static_cast<int>(i)) {
        critic.Reject(*joints.at(name), "mimics " + Quoted(source),
                      "which mimics it in turn: mimics must not form a cycle");
      }
      name = source;
    }
  }
}

// Notes each mimic joint that leaves its own limits when its source reaches an
// end of its range.
void CheckRanges(const std::map<std::string, JointLimits>& limits,
                 const Elements& joints, const Critic& critic) {
  constexpr double kTolerance = 1e-2;  // rad or m. Files round numbers.
  for (const auto& [name, own] : limits) {
    const XMLElement* mimic = joints.at(name)->FirstChildElement("mimic");
    if (mimic == nullptr) continue;
    const auto source = limits.find(Text(*mimic, "joint"));
    if (source == limits.end()) continue;
    const double multiplier = Number(*mimic, "multiplier", 1);
    const double offset = Number(*mimic, "offset", 0);
    for (const double end : {source->second.lower, source->second.upper}) {
      const double q = multiplier * end + offset;
      if (!std::isfinite(q) ||
          (q >= own.lower - kTolerance && q <= own.upper + kTolerance)) {
        continue;
      }
      critic.Note(*mimic, "moves the joint to " + PrintNumber(q),
                  "which is outside its limits");
      break;
    }
  }
}

}  // namespace

void CheckMimics(const std::vector<std::string>& names, const Elements& joints,
                 const std::map<std::string, JointLimits>& limits,
                 const Critic& critic) {
  for (const std::string& name : names) {
    if (IsMoving(*joints.at(name))) {
      CheckSource(*joints.at(name), joints, critic);
    }
  }
  CheckCycles(names, joints, critic);
  CheckRanges(limits, joints, critic);
}

}  // namespace poise
