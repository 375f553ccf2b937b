// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_xml.h"

#include <string_view>

#include "poise/robot/numbers.h"

namespace poise {

using tinyxml2::XMLElement;

std::string Text(const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  return text != nullptr ? text : "";
}

double Number(const XMLElement& element, const char* attribute,
              double otherwise) {
  const char* text = element.Attribute(attribute);
  return text != nullptr ? ParseNumbers(text).value().at(0) : otherwise;
}

Eigen::Vector3d Vector(const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(ParseNumbers(text).value().data());
}

bool IsMoving(const XMLElement& joint) {
  const std::string type = Text(joint, "type");
  return type == "revolute" || type == "continuous" || type == "prismatic";
}

void Critic::Add(Severity severity, const XMLElement& element, std::string what,
                 std::string why) const {
  // Bounds the memory. At least one finding that rejects the file is always
  // kept.
  constexpr size_t kMostFindings = 10'000;
  if (findings_->size() >= kMostFindings &&
      (severity != Severity::kReject ||
       findings_->back().severity == Severity::kReject)) {
    return;
  }
  constexpr size_t kLongest = 60;
  std::string where =
      "<" + OneLine(std::string_view(element.Name()).substr(0, kLongest)) + ">";
  const tinyxml2::XMLNode* robot = element.GetDocument()->RootElement();
  const tinyxml2::XMLNode* top = &element;  // Becomes the link or the joint.
  while (top != robot && top->Parent() != robot) top = top->Parent();
  const char* name = top->ToElement()->Attribute("name");
  if (top != robot && name != nullptr) {
    where = std::string(top->Value()) + " " + Quoted(name) +
            (top == &element ? "" : " " + where);
  }
  findings_->push_back(
      {severity, where, std::move(what), std::move(why), element.GetLineNum()});
}

}  // namespace poise
