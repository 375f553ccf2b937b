// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "poise/dynamics/tree.h"
#include "poise/robot/control/task.h"
#include "poise/robot/robot.h"

namespace poise {

/// Pattern of a row: the end of its name, its unit, and its phrase, in which
/// `%` is replaced by the foot or joint in words.
struct RowPattern {
  std::string_view end;
  std::string_view unit;
  std::string_view phrase;
};

/// Returns a phrase with the words of a name in place of `%`: "left_foot" is
/// "left foot".
inline std::string FillPhrase(std::string_view phrase, std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  std::string filled(phrase);
  const size_t at = filled.find('%');
  return at == std::string::npos ? filled : filled.replace(at, 1, name);
}

/// Rows "left_foot.cop.x_max", ...: each pattern for one foot.
inline void AddFootRows(const Foot& foot, std::string_view what, RowKind kind,
                        std::initializer_list<RowPattern> patterns,
                        std::vector<RowDescription>* rows) {
  for (const RowPattern& pattern : patterns) {
    rows->push_back(
        {foot.name + "." + std::string(what) + "." + std::string(pattern.end),
         std::string(pattern.unit), FillPhrase(pattern.phrase, foot.name),
         kind});
  }
}

/// Rows "left_foot.cop.x_max", ...: each pattern for each foot.
inline std::vector<RowDescription> FootRows(
    const std::vector<Foot>& feet, std::string_view what, RowKind kind,
    std::initializer_list<RowPattern> patterns) {
  std::vector<RowDescription> rows;
  for (const Foot& foot : feet) AddFootRows(foot, what, kind, patterns, &rows);
  return rows;
}

/// Returns a row "torque.l_knee", for a revolute or a prismatic joint. The end
/// of the pattern's name is not used.
inline RowDescription JointRow(const Joint& joint, std::string_view what,
                               RowKind kind, const RowPattern& turns,
                               const RowPattern& slides) {
  const bool is_slider = joint.type == JointType::kPrismatic;
  const RowPattern& pattern = is_slider ? slides : turns;
  return {std::string(what) + "." + joint.name, std::string(pattern.unit),
          FillPhrase(pattern.phrase, joint.name), kind};
}

/// Rows "torque.l_knee", ...: one for each joint.
inline std::vector<RowDescription> JointRows(const Tree& tree,
                                             std::string_view what,
                                             RowKind kind,
                                             const RowPattern& turns,
                                             const RowPattern& slides) {
  std::vector<RowDescription> rows;
  for (const Joint& joint : tree.joints()) {
    rows.push_back(JointRow(joint, what, kind, turns, slides));
  }
  return rows;
}

/// Rows "momentum.lx", ...
inline std::vector<RowDescription> AxisRows(
    std::string_view what, RowKind kind,
    std::initializer_list<RowPattern> patterns) {
  std::vector<RowDescription> rows;
  for (const RowPattern& pattern : patterns) {
    rows.push_back({std::string(what) + "." + std::string(pattern.end),
                    std::string(pattern.unit), std::string(pattern.phrase),
                    kind});
  }
  return rows;
}

/// Rows "frame.l_hand.wx", ...: rotation, then translation of a link.
inline std::vector<RowDescription> FrameRows(const std::string& link) {
  std::vector<RowDescription> rows =
      AxisRows("frame." + link, RowKind::kTarget,
               {{"wx", "rad/s2", "the rotation of the % about x"},
                {"wy", "rad/s2", "the rotation of the % about y"},
                {"wz", "rad/s2", "the rotation of the % about z"},
                {"vx", "m/s2", "the motion of the % along x"},
                {"vy", "m/s2", "the motion of the % along y"},
                {"vz", "m/s2", "the motion of the % along z"}});
  for (auto& row : rows) row.phrase = FillPhrase(row.phrase, link);
  return rows;
}

}  // namespace poise
