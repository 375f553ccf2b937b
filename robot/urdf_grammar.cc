// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/urdf_grammar.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "robot/urdf_xml.h"

namespace poise {
namespace {

using tinyxml2::XMLElement;

struct AttributeRule {
  const char* name;
  int numbers;  // So many; 0 for text.
  bool required = true;
};

struct ElementRule {
  const char* name;
  std::vector<AttributeRule> attributes;
  std::vector<const ElementRule*> children;
  bool required = false;
  bool repeated = false;
  // What it is to lack a part: the element is taken away, or the file rejected.
  Severity fault = Severity::kReject;
};

constexpr bool kOptional = false;

// What Poise reads of a URDF.
const ElementRule kOrigin{
    "origin", {{"xyz", 3, kOptional}, {"rpy", 3, kOptional}}, {}};
const ElementRule kMass{"mass", {{"value", 1}}, {}, true};
const ElementRule kInertia{
    "inertia",
    {{"ixx", 1}, {"ixy", 1}, {"ixz", 1}, {"iyy", 1}, {"iyz", 1}, {"izz", 1}},
    {},
    true};
const ElementRule kInertial{"inertial", {}, {&kOrigin, &kMass, &kInertia}};
const ElementRule kBox{"box", {{"size", 3}}, {}};
const ElementRule kSphere{"sphere", {{"radius", 1}}, {}};
const ElementRule kCylinder{"cylinder", {{"radius", 1}, {"length", 1}}, {}};
const ElementRule kMesh{"mesh", {{"filename", 0}, {"scale", 3, kOptional}},
                        {},     false,
                        false,  Severity::kWarn};
const ElementRule kGeometry{
    "geometry", {},    {&kBox, &kSphere, &kCylinder, &kMesh},
    true,       false, Severity::kWarn};
const ElementRule kColor{"color", {{"rgba", 4}}, {},
                         false,   false,         Severity::kWarn};
const ElementRule kTexture{"texture", {{"filename", 0}}, {}, false,
                           false,     Severity::kNote};
const ElementRule kMaterial{"material", {{"name", 0}}, {&kColor, &kTexture},
                            false,      false,         Severity::kWarn};
const ElementRule kVisual{"visual", {},   {&kOrigin, &kGeometry, &kMaterial},
                          false,    true, Severity::kWarn};
const ElementRule kCollision{"collision", {},   {&kOrigin, &kGeometry},
                             false,       true, Severity::kWarn};
const ElementRule kLink{
    "link", {{"name", 0}}, {&kInertial, &kVisual, &kCollision}, false, true};
const ElementRule kParent{"parent", {{"link", 0}}, {}, true};
const ElementRule kChild{"child", {{"link", 0}}, {}, true};
const ElementRule kAxis{"axis", {{"xyz", 3}}, {}};
const ElementRule kLimit{"limit",
                         {{"lower", 1, kOptional},
                          {"upper", 1, kOptional},
                          {"effort", 1},
                          {"velocity", 1}},
                         {}};
const ElementRule kDynamics{
    "dynamics", {{"damping", 1, kOptional}, {"friction", 1, kOptional}}, {}};
const ElementRule kMimic{
    "mimic",
    {{"joint", 0}, {"multiplier", 1, kOptional}, {"offset", 1, kOptional}},
    {}};
const ElementRule kJoint{
    "joint",
    {{"name", 0}, {"type", 0}},
    {&kOrigin, &kParent, &kChild, &kAxis, &kLimit, &kDynamics, &kMimic},
    false,
    true};
const ElementRule kMaterialAtTop{
    "material", {{"name", 0}}, {&kColor, &kTexture},
    false,      true,          Severity::kWarn};
const ElementRule kRobot{
    "robot", {{"name", 0}}, {&kMaterialAtTop, &kLink, &kJoint}};

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

// Any white space as one blank, none at the ends.
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

// Why a text is not the numbers it should be.
std::string WantedNumbers(std::string_view text, int count) {
  if (text.find("${") != std::string_view::npos ||
      text.find("$(") != std::string_view::npos) {
    return "is xacro, expand it first";
  }
  const std::string wanted =
      count == 1 ? "must be a number"
                 : "must be " + std::to_string(count) + " numbers";
  if (text.find(',') != std::string_view::npos) {
    return wanted + " with a decimal point, not a comma";
  }
  return wanted;
}

class Pruner {
 public:
  explicit Pruner(std::vector<Finding>* findings) : critic_(findings) {}

  // Whether the element may stay.
  bool Prune(const ElementRule& rule, XMLElement* element) {
    PruneAttributes(rule, element);
    bool complete = true;
    for (const AttributeRule& attribute : rule.attributes) {
      complete &= CheckAttribute(rule, attribute, element);
    }
    // A fixed joint has no use for an axis or limits; many files have bad ones.
    const char* type = element->Attribute("type");
    const bool is_still = &rule == &kJoint && type != nullptr &&
                          (type == std::string_view("fixed") ||
                           type == std::string_view("floating"));
    std::set<const ElementRule*> seen;
    XMLElement* child = element->FirstChildElement();
    for (XMLElement* next = nullptr; child != nullptr; child = next) {
      next = child->NextSiblingElement();
      const ElementRule* child_rule = Find(rule, *child);
      bool keep =
          child_rule != nullptr &&
          !(is_still && (child_rule == &kAxis || child_rule == &kLimit ||
                         child_rule == &kDynamics || child_rule == &kMimic));
      if (keep && !child_rule->repeated && !seen.insert(child_rule).second) {
        critic_.Warn(*child, "is there twice", "the first one is read");
        keep = false;
      }
      if (!keep || !Prune(*child_rule, child)) {
        if (keep) seen.erase(child_rule);
        element->DeleteChild(child);
      }
    }
    for (const ElementRule* wanted : rule.children) {
      if (!wanted->required || seen.count(wanted) != 0) continue;
      complete = false;
      critic_.Add(
          rule.fault, *element, std::string("has no <") + wanted->name + ">",
          rule.fault == Severity::kReject ? "must have one" : "is left out");
    }
    if (&rule == &kGeometry && seen.empty()) {
      complete = false;
      critic_.Warn(*element, "has no shape that can be read",
                   "must be box, sphere, cylinder or mesh");
    }
    return complete || rule.fault == Severity::kReject;
  }

 private:
  // The rule for a child, or null where it is not read.
  const ElementRule* Find(const ElementRule& rule, const XMLElement& child) {
    for (const ElementRule* candidate : rule.children) {
      if (child.Name() == std::string_view(candidate->name)) return candidate;
    }
    if (StartsWith(child.Name(), "xacro:")) {
      critic_.Reject(child, "is xacro", "expand it first");
    } else if (&rule == &kRobot &&
               child.Name() == std::string_view("loop_joint")) {
      critic_.Note(
          child, "closes a loop",
          "loops are not modeled: the robot moves as if it were cut there");
    }
    return nullptr;
  }

  static void PruneAttributes(const ElementRule& rule, XMLElement* element) {
    const tinyxml2::XMLAttribute* attribute = element->FirstAttribute();
    while (attribute != nullptr) {
      const std::string name = attribute->Name();
      attribute = attribute->Next();
      const bool is_read =
          std::any_of(rule.attributes.begin(), rule.attributes.end(),
                      [&](const AttributeRule& a) { return name == a.name; });
      if (!is_read) element->DeleteAttribute(name.c_str());
    }
  }

  bool CheckAttribute(const ElementRule& rule, const AttributeRule& attribute,
                      XMLElement* element) {
    const char* text = element->Attribute(attribute.name);
    if (text == nullptr) {
      if (!attribute.required) return true;
      critic_.Add(
          rule.fault, *element, std::string("has no ") + attribute.name,
          rule.fault == Severity::kReject ? "must have one" : "is left out");
      return false;
    }
    if (attribute.numbers == 0) return true;
    const auto numbers = ParseNumbers(text);
    if (!numbers || static_cast<int>(numbers->size()) != attribute.numbers) {
      critic_.Add(rule.fault, *element,
                  std::string(attribute.name) + " is " + Quoted(text),
                  WantedNumbers(text, attribute.numbers));
      return false;
    }
    // Unlimited is a limit; nothing else is infinite.
    for (const double number : *numbers) {
      if (std::isfinite(number) || (&rule == &kLimit && !std::isnan(number))) {
        continue;
      }
      critic_.Add(rule.fault, *element,
                  std::string(attribute.name) + " is " + Quoted(text),
                  "must be finite");
      return false;
    }
    // urdfdom splits at blanks alone.
    element->SetAttribute(attribute.name, Collapse(text).c_str());
    return true;
  }

  Critic critic_;
};

}  // namespace

void PruneUrdf(XMLElement* robot, std::vector<Finding>* findings) {
  Pruner(findings).Prune(kRobot, robot);
}

}  // namespace poise
