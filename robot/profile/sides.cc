// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/sides.h"

#include <optional>
#include <stdexcept>

#include "poise/robot/feet/feet_hints.h"
#include "poise/robot/feet/find_feet.h"
#include "poise/robot/feet/forward.h"

namespace poise {
namespace {

// Returns the body of the foot that a profile names.
int BodyOfFoot(const RobotModel& model, const std::string& file,
               const std::string& key, const TextValue& link) {
  const auto refuse = [&](const std::string& what) {
    throw Refusal(file, link.line, key + ": " + what);
  };
  const std::optional<int> frame = model.tree.FindFrame(link.text);
  if (!frame) refuse("the robot has no link " + Quoted(link.text));
  const int body = model.tree.frames()[*frame].body;
  if (body == 0) {
    refuse(Quoted(link.text) +
           " is fixed to the root link, must be the last link of a leg");
  }
  return body;
}

// Returns what `forward`, `left` and `right` say.
FeetHints HintsOf(const RobotModel& model, const Sides& sides,
                  const std::string& file) {
  FeetHints hints;
  hints.forward_B = AxisOfName(sides.forward.text);
  if (sides.left.text.empty()) return hints;
  hints.feet = {BodyOfFoot(model, file, "left", sides.left),
                BodyOfFoot(model, file, "right", sides.right)};
  if ((*hints.feet)[0] == (*hints.feet)[1]) {
    throw Refusal(file, sides.right.line,
                  "right: " + Quoted(sides.right.text) +
                      " is on the same body as left, must be on another");
  }
  return hints;
}

}  // namespace

std::vector<Foot> FindFeetOf(const RobotModel& model, const Sides& sides,
                             const std::string& file,
                             std::vector<Finding>* findings) {
  const FeetHints hints = HintsOf(model, sides, file);
  if (!hints.feet) return FindFeet(model, findings, hints);
  try {
    return FindFeet(model, findings, hints);
  } catch (const std::invalid_argument& error) {
    throw Refusal(file, sides.left.line,
                  "left and right: " + std::string(error.what()));
  }
}

void CheckSides(const Robot& robot, const Sides& sides, const std::string& file,
                bool gives_feet) {
  const std::string axis = ForwardAxis(robot);
  const std::string& forward = sides.forward.text;
  if (!forward.empty() && forward != axis) {
    const auto opposite = AxisOfName(axis);
    std::string wanted =
        axis.empty() ? "left out: the feet point along no axis" : axis;
    if (opposite && sides.left.text.empty() && !gives_feet) {
      wanted += " or " + NameOfAxis(-*opposite) +
                ", across the line between the feet";
    } else if (opposite) {
      wanted += std::string(" to agree with ") +
                (gives_feet ? "feet" : "left and right");
    }
    throw Refusal(file, sides.forward.line,
                  "forward is '" + forward + "', must be " + wanted);
  }
  if (sides.left.text.empty() || !gives_feet) return;
  for (const int i : {0, 1}) {
    const std::string key = i == 0 ? "left" : "right";
    const TextValue& link = i == 0 ? sides.left : sides.right;
    if (BodyOfFoot(robot.model, file, key, link) == robot.feet[i].body) {
      continue;
    }
    throw Refusal(file, link.line,
                  key + ": " + Quoted(link.text) + " is not on the body of " +
                      robot.feet[i].name + ", must agree with feet");
  }
}

}  // namespace poise
