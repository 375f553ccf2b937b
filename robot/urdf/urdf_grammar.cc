// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf_grammar.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "poise/robot/numbers.h"
#include "poise/robot/urdf/urdf_rules.h"
#include "poise/robot/urdf/urdf_xacro.h"
#include "poise/robot/urdf/urdf_xml.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;
using urdf_rules::kAxis;
using urdf_rules::kBox;
using urdf_rules::kChild;
using urdf_rules::kCylinder;
using urdf_rules::kDynamics;
using urdf_rules::kGeometry;
using urdf_rules::kLimit;
using urdf_rules::kLink;
using urdf_rules::kMimic;
using urdf_rules::kOrigin;
using urdf_rules::kParent;
using urdf_rules::kRobot;
using urdf_rules::kSphere;

// Bound on numbers. It is larger than any number of a robot, and small enough
// that sums of squares do not overflow.
constexpr double kLargest = 1e30;

// Elements that other programs read. They give no finding. An element with a
// colon in its name is also for other programs.
const std::set<std::string_view> kOfOthers = {"actuator",
                                              "calibration",
                                              "capsule",
                                              "collision_checking",
                                              "contact",
                                              "frame",
                                              "gazebo",
                                              "gripper",
                                              "group",
                                              "hardwareInterface",
                                              "limited_ft_sensor",
                                              "mechanicalReduction",
                                              "mujoco",
                                              "ros2_control",
                                              "safety_controller",
                                              "self_collide",
                                              "self_collision_checking",
                                              "sensor",
                                              "static",
                                              "transmission",
                                              "verbose"};

// Elements that change the dynamics. They give a warning if they are in a wrong
// place.
const std::set<std::string_view> kOfDynamics = {
    "axis",  "child", "dynamics", "inertia", "inertial", "joint",
    "limit", "link",  "mass",     "mimic",   "origin",   "parent"};

// Attributes of <origin> that replace rpy in other formats.
const std::set<std::string_view> kRotations = {"quat", "quat_wxyz",
                                               "quat_xyzw"};

bool Contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

char Lower(char c) { return 'A' <= c && c <= 'Z' ? c - 'A' + 'a' : c; }

// Returns whether two words are equal except for case and for at most one
// letter that is added, missing or replaced.
bool IsSlip(std::string_view word, std::string_view wanted) {
  if (word.size() > wanted.size()) std::swap(word, wanted);
  if (wanted.size() - word.size() > 1) return false;
  const auto same = [](char a, char b) { return Lower(a) == Lower(b); };
  const auto [here, there] =
      std::mismatch(word.begin(), word.end(), wanted.begin(), same);
  if (here == word.end()) return true;
  const bool is_longer = wanted.size() > word.size();
  return std::equal(is_longer ? here : here + 1, word.end(), there + 1, same);
}

// Replaces each run of white space by one space, and removes white space at
// both ends.
std::string Collapse(std::string_view text) {
  std::string collapsed;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank) {
      collapsed += c;
    } else if (!collapsed.empty() && collapsed.back() != ' ') {
      collapsed += ' ';
    }
  }
  if (!collapsed.empty() && collapsed.back() == ' ') collapsed.pop_back();
  return collapsed;
}

// Returns the rule that a text breaks if it is not `count` numbers.
std::string WantedNumbers(std::string_view text, int count) {
  if (HasXacroExpression(text)) return "is xacro, expand the file first";
  const std::string wanted =
      count == 1 ? "must be a number"
                 : "must be " + std::to_string(count) + " numbers";
  if (Contains(text, ",")) {
    return wanted + " with a decimal point, not a comma";
  }
  return wanted;
}

class Pruner {
 public:
  explicit Pruner(std::vector<Finding>* findings) : critic_(findings) {}

  // Prunes an element, and returns whether the element can be kept.
  bool Prune(const ElementRule& rule, XMLElement* element);

 private:
  // The children of an element, by rule.
  struct Parts {
    std::set<const ElementRule*> kept;
    std::set<const ElementRule*> spoilt;  // Removed: a part is invalid.
  };

  // Prunes a child, and returns whether the child can be kept.
  bool PruneNode(const ElementRule& rule, const XMLElement& element,
                 tinyxml2::XMLNode* node, Parts* parts);

  // Returns whether a child has no effect. A fixed joint needs neither axis nor
  // limits, and many files have invalid ones.
  static bool IsIdle(const XMLElement& element, const ElementRule& child) {
    const char* type = element.Attribute("type");
    return type != nullptr &&
           (type == std::string_view("fixed") ||
            type == std::string_view("floating")) &&
           (&child == &kAxis || &child == &kLimit || &child == &kDynamics ||
            &child == &kMimic);
  }

  // Returns whether an element has all required children.
  bool CheckParts(const ElementRule& rule, const XMLElement& element,
                  const Parts& parts);

  // Returns the rule for a child, or null if Poise does not read the child.
  const ElementRule* Find(const ElementRule& rule, const XMLElement& child);

  // Adds a finding about an element that xacro should have replaced. For
  // example, a macro of sensors can be left out of a robot or a link. Inside a
  // joint or an inertial, each element is essential.
  void JudgeXacro(const ElementRule& rule, const XMLElement& element);

  void PruneAttributes(const ElementRule& rule, XMLElement* element) {
    const tinyxml2::XMLAttribute* attribute = element->FirstAttribute();
    while (attribute != nullptr) {
      const std::string name = attribute->Name();
      attribute = attribute->Next();
      const bool is_read =
          std::any_of(rule.attributes.begin(), rule.attributes.end(),
                      [&](const AttributeRule& a) { return name == a.name; });
      if (is_read) continue;
      JudgeAttribute(rule, *element, name);
      element->DeleteAttribute(name.c_str());
    }
  }

  // Adds a finding about an attribute that Poise does not read.
  void JudgeAttribute(const ElementRule& rule, const XMLElement& element,
                      const std::string& name);

  bool CheckAttribute(const ElementRule& rule, const AttributeRule& attribute,
                      XMLElement* element);

  Critic critic_;
};

bool Pruner::Prune(const ElementRule& rule, XMLElement* element) {
  PruneAttributes(rule, element);
  bool complete = true;
  for (const AttributeRule& attribute : rule.attributes) {
    complete &= CheckAttribute(rule, attribute, element);
  }
  Parts parts;
  tinyxml2::XMLNode* node = element->FirstChild();
  for (tinyxml2::XMLNode* next = nullptr; node != nullptr; node = next) {
    next = node->NextSibling();
    if (!PruneNode(rule, *element, node, &parts)) element->DeleteChild(node);
  }
  complete &= CheckParts(rule, *element, parts);
  return complete || rule.fault == Severity::kReject;
}

bool Pruner::PruneNode(const ElementRule& rule, const XMLElement& element,
                       tinyxml2::XMLNode* node, Parts* parts) {
  XMLElement* child = node->ToElement();
  if (child == nullptr) {
    if (node->ToText() != nullptr) {
      critic_.Warn(element, "holds the text " + Quoted(Collapse(node->Value())),
                   "is ignored: URDF stores values in attributes");
    }
    return false;
  }
  const ElementRule* child_rule = Find(rule, *child);
  if (child_rule == nullptr || IsIdle(element, *child_rule)) return false;
  if (!child_rule->repeated && parts->kept.count(child_rule) != 0) {
    if (child_rule == &kParent || child_rule == &kChild) {
      critic_.Reject(*child, "occurs twice", "a joint connects two links");
    } else {
      critic_.Warn(*child, "occurs twice", "only the first one is used");
    }
    return false;
  }
  if (&rule == &kGeometry && !parts->kept.empty()) {
    critic_.Warn(*child, "is a second shape", "only the first one is used");
    return false;
  }
  const bool keep = Prune(*child_rule, child);
  (keep ? parts->kept : parts->spoilt).insert(child_rule);
  return keep;
}

bool Pruner::CheckParts(const ElementRule& rule, const XMLElement& element,
                        const Parts& parts) {
  bool complete = true;
  for (const ElementRule* wanted : rule.children) {
    if (!wanted->required || parts.kept.count(wanted) != 0) continue;
    complete = false;
    if (parts.spoilt.count(wanted) != 0) continue;  // Already reported.
    critic_.Add(
        rule.fault, element, std::string("has no <") + wanted->name + ">",
        rule.fault == Severity::kReject ? "must have one" : "is left out");
  }
  if (&rule == &kGeometry && parts.kept.empty()) {
    complete = false;
    if (parts.spoilt.empty()) {
      critic_.Warn(element, "has no shape that can be read",
                   "must be box, sphere, cylinder or mesh");
    }
  }
  return complete;
}

const ElementRule* Pruner::Find(const ElementRule& rule,
                                const XMLElement& child) {
  for (const ElementRule* candidate : rule.children) {
    if (child.Name() == std::string_view(candidate->name)) return candidate;
  }
  const std::string_view name = child.Name();
  if (IsXacro(child)) {
    JudgeXacro(rule, child);
  } else if (&rule == &kRobot && name == "loop_joint") {
    critic_.Note(
        child, "closes a loop",
        "loops are not modeled: the robot moves as if the loop were cut");
  } else if (IsXacroWithoutPrefix(child)) {
    critic_.Warn(child, "is xacro without a prefix",
                 "is ignored: expand the file with xacro first");
  } else if (kOfDynamics.count(name) != 0) {
    critic_.Warn(child, "is not a URDF element here",
                 "is ignored: is it in the wrong place?");
  } else if (kOfOthers.count(name) == 0 && !Contains(name, ":")) {
    for (const ElementRule* candidate : rule.children) {
      if (!IsSlip(name, candidate->name)) continue;
      critic_.Warn(
          child, "is not a URDF element",
          std::string("is ignored: did you mean <") + candidate->name + ">?");
      return nullptr;
    }
    critic_.Note(child, "is not a URDF element here", "is ignored");
  }
  return nullptr;
}

void Pruner::JudgeXacro(const ElementRule& rule, const XMLElement& element) {
  const bool is_inside_essential =
      rule.fault == Severity::kReject && &rule != &kRobot && &rule != &kLink;
  if (is_inside_essential || HasEssentialPart(element)) {
    critic_.Reject(element, "is xacro",
                   "expand the file with xacro first: the robot would lose a "
                   "link, a joint, a limit or mass");
    return;
  }
  const char* file = element.Attribute("filename");
  critic_.Warn(element,
               file != nullptr ? "is xacro of the file " + Quoted(file)
                               : std::string("is xacro"),
               "is ignored: expand the file with xacro first to keep the parts "
               "that it adds");
}

void Pruner::JudgeAttribute(const ElementRule& rule, const XMLElement& element,
                            const std::string& name) {
  if (Contains(name, ":") || name == "xmlns") return;
  const std::string what = "has " + Quoted(name);
  if (&rule == &kOrigin && kRotations.count(name) != 0) {
    critic_.Reject(element, what, "must have rpy: the rotation would be lost");
    return;
  }
  for (const AttributeRule& wanted : rule.attributes) {
    if (!IsSlip(name, wanted.name)) continue;
    critic_.Warn(element, what,
                 std::string("is ignored: did you mean ") + wanted.name + "?");
    return;
  }
  critic_.Note(element, what, "is ignored: is not a URDF attribute here");
}

bool Pruner::CheckAttribute(const ElementRule& rule,
                            const AttributeRule& attribute,
                            XMLElement* element) {
  const char* text = element->Attribute(attribute.name);
  if (text == nullptr) {
    if (!attribute.required) return true;
    critic_.Add(
        rule.fault, *element, std::string("has no ") + attribute.name,
        rule.fault == Severity::kReject ? "must have one" : "is left out");
    return false;
  }
  const auto refuse = [&](const std::string& why) {
    critic_.Add(rule.fault, *element,
                std::string(attribute.name) + " is " + Quoted(text), why);
    return false;
  };
  if (!IsUtf8(text)) return refuse("must be UTF-8");
  if (attribute.numbers == 0) {
    if (HasXacroExpression(text)) {
      critic_.Warn(*element,
                   std::string(attribute.name) + " is " + Quoted(text),
                   "looks like xacro: was the file expanded?");
    }
    return true;
  }
  const auto numbers = ParseNumbers(text);
  if (!numbers || static_cast<int>(numbers->size()) != attribute.numbers) {
    return refuse(WantedNumbers(text, attribute.numbers));
  }
  for (const double number : *numbers) {
    if (std::isnan(number)) return refuse("must be finite");
    const bool is_size =
        &rule == &kBox || &rule == &kSphere || &rule == &kCylinder;
    if (is_size && number < 0) return refuse("must be zero or positive");
    // A limit may be infinite; all other numbers must be finite.
    if (&rule == &kLimit || std::abs(number) <= kLargest) continue;
    return refuse("is out of range, must be within -1e30 and 1e30");
  }
  // urdfdom accepts only spaces between numbers.
  element->SetAttribute(attribute.name, Collapse(text).c_str());
  return true;
}

}  // namespace

void PruneUrdf(XMLElement* robot, std::vector<Finding>* findings) {
  Pruner(findings).Prune(kRobot, robot);
}

}  // namespace poise
