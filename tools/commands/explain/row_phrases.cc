// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/commands/explain/describe_row.h"

#include <algorithm>

namespace poise {

std::string Spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string DescribeRow(const std::string& name) {
  const size_t first = name.find('.');
  const size_t last = name.rfind('.');
  if (first == std::string::npos) return name;
  const std::string head = name.substr(0, first);
  const std::string end = name.substr(last + 1);
  const std::string middle =
      last > first ? name.substr(first + 1, last - first - 1) : "";
  if (head == "torque" || head == "joint") {
    if (last == first) {
      return "the " + head + " limit of " + Spaced(end);
    }
    return "the " + std::string(head == "torque" ? "torque" : "angle") +
           " of " + Spaced(middle) + " at its " +
           (end == "min" ? "lower" : "upper") + " limit";
  }
  if (head == "zmp" || head == "zmp_literal") {
    return "the combined CoP at " + end + " of its box";
  }
  if (head == "capture_point") return "the capture point at " + end;
  const std::string foot = "the " + Spaced(head);
  if (middle == "cop") {
    const bool is_left = head.rfind("left", 0) == 0;
    const std::string edge = end == "x_max"                ? "front"
                             : end == "x_min"              ? "rear"
                             : (end == "y_max") == is_left ? "outer"
                                                           : "inner";
    return "the CoP of " + foot + " at its " + edge + " edge";
  }
  if (middle == "friction") return foot + " at its friction limit";
  if (middle == "unilateral.fz" && end == "min") {
    return foot + " without load";
  }
  if (middle == "unilateral.fz" && end == "max") {
    return foot + " at the most that it may bear";
  }
  if (middle == "unilateral") return "the normal force of " + foot;
  if (middle.rfind("yaw", 0) == 0) return "the yaw moment of " + foot;
  return name;
}

}  // namespace poise
