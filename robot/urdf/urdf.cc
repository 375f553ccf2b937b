// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/urdf/urdf.h"

#include <console_bridge/console.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "poise/robot/text_file.h"
#include "poise/robot/urdf/urdf_check.h"
#include "poise/robot/urdf/urdf_xml.h"
#include "poise/robot/urdf/xml_file.h"

namespace poise {
namespace {

// Bound on the file's size. Together with the bound of 16 MiB on markup, it
// keeps the memory below 1 GiB.
constexpr size_t kMostMib = 112;

Eigen::Vector3d FromUrdf(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose FromUrdf(const urdf::Pose& X) {
  const urdf::Rotation& r = X.rotation;
  return {Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix(),
          FromUrdf(X.position)};
}

// Converts an inertial. Both give the inertia about the center of mass. URDF
// uses the axes of the frame in <origin>; Inertia uses the axes of the link.
Inertia FromUrdf(const urdf::Inertial& inertial) {
  const Pose X_LG = FromUrdf(inertial.origin);
  Eigen::Matrix3d I;
  I << inertial.ixx, inertial.ixy, inertial.ixz,  //
      inertial.ixy, inertial.iyy, inertial.iyz,   //
      inertial.ixz, inertial.iyz, inertial.izz;
  const Eigen::Matrix3d I_G_L = X_LG.R * I * X_LG.R.transpose();
  return {inertial.mass, X_LG.p, 0.5 * (I_G_L + I_G_L.transpose())};
}

JointType FromUrdf(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::kRevolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::kContinuous;
    case urdf::Joint::PRISMATIC:
      return JointType::kPrismatic;
    case urdf::Joint::FIXED:
      return JointType::kFixed;
    default:
      throw std::invalid_argument("joint " + Quoted(joint.name) +
                                  ": its type is floating or planar, must be "
                                  "revolute, continuous, prismatic or fixed");
  }
}

Geometry FromUrdf(const urdf::Geometry& geometry) {
  switch (geometry.type) {
    case urdf::Geometry::SPHERE:
      return Sphere{static_cast<const urdf::Sphere&>(geometry).radius};
    case urdf::Geometry::BOX:
      return Box{FromUrdf(static_cast<const urdf::Box&>(geometry).dim)};
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      return Cylinder{cylinder.radius, cylinder.length};
    }
    default: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      return Mesh{mesh.filename, FromUrdf(mesh.scale)};
    }
  }
}

void AddShapes(const urdf::Link& link, int frame, RobotModel* model) {
  for (const auto& visual : link.visual_array) {
    Shape shape{frame, FromUrdf(visual->origin), FromUrdf(*visual->geometry)};
    if (visual->material != nullptr) {
      const urdf::Color& color = visual->material->color;
      shape.rgba =
          Eigen::Vector4f(color.r, color.g, color.b, color.a).cast<double>();
    }
    model->visuals.push_back(std::move(shape));
  }
  for (const auto& collision : link.collision_array) {
    model->collisions.push_back(
        {frame, FromUrdf(collision->origin), FromUrdf(*collision->geometry)});
  }
}

// Prevents urdfdom from printing messages, because urdfdom uses names from the
// file as format strings.
class Silence {
 public:
  Silence() : level_(console_bridge::getLogLevel()) {
    console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
  }
  ~Silence() { console_bridge::setLogLevel(level_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  console_bridge::LogLevel level_;
};

// Owns urdfdom's tree. urdfdom destroys the tree recursively, link by link,
// which would overflow the stack for a long chain. The destructor avoids the
// recursion.
class UrdfdomTree {
 public:
  explicit UrdfdomTree(const std::string& xml) {
    const Silence silence;
    model_ = urdf::parseURDF(xml);
  }
  ~UrdfdomTree() {
    if (model_ == nullptr) return;
    for (const auto& [name, link] : model_->links_) {
      link->child_links.clear();
    }
  }
  UrdfdomTree(const UrdfdomTree&) = delete;
  UrdfdomTree& operator=(const UrdfdomTree&) = delete;

  const urdf::ModelInterface* get() const { return model_.get(); }

 private:
  urdf::ModelInterfaceSharedPtr model_;
};

// Returns the pruned document as text for urdfdom. Parts for which urdfdom is
// too strict are removed or set to 0, because they have already been read.
std::string XmlForUrdfdom(tinyxml2::XMLDocument* document) {
  for (tinyxml2::XMLElement* joint =
           document->RootElement()->FirstChildElement("joint");
       joint != nullptr; joint = joint->NextSiblingElement("joint")) {
    if (auto* dynamics = joint->FirstChildElement("dynamics")) {
      joint->DeleteChild(dynamics);
    }
    if (auto* limit = joint->FirstChildElement("limit")) {
      for (const char* name : {"lower", "upper", "effort", "velocity"}) {
        limit->SetAttribute(name, "0");
      }
    }
  }
  tinyxml2::XMLPrinter printer(nullptr, /*compact=*/true);
  document->RootElement()->Accept(&printer);
  return {printer.CStr(), static_cast<size_t>(printer.CStrSize() - 1)};
}

Tree MakeTree(const urdf::ModelInterface& urdf, const UrdfFacts& facts,
              const std::map<std::string, double>& locked,
              const std::map<std::string, Inertia>& added) {
  TreeBuilder builder;
  builder.AcceptUnphysicalInertias();  // CheckInertial() warns.
  for (const std::string& name : facts.tree.links) {
    const auto& inertial = urdf.links_.at(name)->inertial;
    Inertia M = inertial != nullptr ? FromUrdf(*inertial) : Inertia{};
    if (const auto more = added.find(name); more != added.end()) {
      M = M + more->second;
    }
    builder.AddLink(name, M);
  }
  for (const std::string& name : facts.tree.joints) {
    const urdf::Joint& joint = *urdf.joints_.at(name);
    builder.AddJoint({name, FromUrdf(joint), joint.parent_link_name,
                      joint.child_link_name,
                      FromUrdf(joint.parent_to_joint_origin_transform),
                      FromUrdf(joint.axis)});
  }
  for (const auto& [name, value] : locked) builder.Lock(name, value);
  return builder.Build();
}

void AddMimics(const urdf::ModelInterface& urdf, RobotModel* model) {
  std::unordered_map<std::string, int> joint_of;
  for (const Joint& joint : model->tree.joints()) {
    joint_of.emplace(joint.name, static_cast<int>(joint_of.size()));
  }
  for (const Joint& joint : model->tree.joints()) {
    const auto& mimic = urdf.joints_.at(joint.name)->mimic;
    if (mimic == nullptr) continue;
    const auto source = joint_of.find(mimic->joint_name);
    if (source == joint_of.end()) continue;  // The source is fixed.
    model->mimics.push_back({joint_of.at(joint.name), source->second,
                             mimic->multiplier, mimic->offset});
  }
}

// Throws the first finding that rejects the file.
void ThrowIfRejected(const std::string& file,
                     const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    if (finding.severity != Severity::kReject) continue;
    throw Refusal(file, finding);
  }
}

}  // namespace

struct UrdfDocument::Content {
  Content(tinyxml2::XMLDocument* xml, UrdfFacts facts_from_xml)
      : facts(std::move(facts_from_xml)), urdfdom(XmlForUrdfdom(xml)) {}

  UrdfFacts facts;
  UrdfdomTree urdfdom;
};

UrdfDocument::UrdfDocument(const std::filesystem::path& file,
                           std::vector<Finding>* findings,
                           std::vector<std::filesystem::path> packages)
    : UrdfDocument(ReadTextFile(file, kMostMib), file.string(), findings) {
  mesh_places_ = {file, std::move(packages)};
}

UrdfDocument::UrdfDocument(std::string_view text, std::string source,
                           std::vector<Finding>* findings)
    : source_(std::move(source)) {
  std::vector<Finding> unasked;
  if (findings == nullptr) findings = &unasked;
  const auto xml = ParseXml(text, source_);
  UrdfFacts facts = CheckUrdf(xml.get(), findings);
  ThrowIfRejected(source_, *findings);
  content_ = std::make_shared<const Content>(xml.get(), std::move(facts));
  if (content_->urdfdom.get() == nullptr) {
    throw Refusal(source_, 0, "urdfdom cannot read the file");
  }
}

RobotModel UrdfDocument::MakeModel(
    const std::map<std::string, double>& locked,
    const std::map<std::string, Inertia>& added) const {
  const UrdfFacts& facts = content_->facts;
  const urdf::ModelInterface& urdf = *content_->urdfdom.get();
  RobotModel model{
      urdf.getName(), MakeTree(urdf, facts, locked, added), {}, {}, {}, {}, 0,
      mesh_places_};
  for (const Joint& joint : model.tree.joints()) {
    model.limits.push_back(facts.limits.at(joint.name));
  }
  AddMimics(urdf, &model);
  for (int i = 0; i < static_cast<int>(model.tree.frames().size()); ++i) {
    const std::string& name = model.tree.frames()[i].name;
    if (name == facts.tree.base) model.root_frame = i;
    AddShapes(*urdf.links_.at(name), i, &model);
  }
  return model;
}

RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked,
                    std::vector<Finding>* findings) {
  return UrdfDocument(file, findings).MakeModel(locked);
}

RobotModel ParseUrdf(std::string_view text, const std::string& source,
                     const std::map<std::string, double>& locked,
                     std::vector<Finding>* findings) {
  return UrdfDocument(text, source, findings).MakeModel(locked);
}

std::map<std::string, double> LoadLinkMasses(
    const std::filesystem::path& file) {
  const auto document = ParseXml(ReadTextFile(file, kMostMib), file.string());
  std::vector<Finding> known;
  std::map<std::string, double> masses;
  for (const std::string& link : CheckUrdf(document.get(), &known).tree.links) {
    masses[link] = 0;
  }
  for (const tinyxml2::XMLElement* link =
           document->RootElement()->FirstChildElement("link");
       link != nullptr; link = link->NextSiblingElement("link")) {
    const auto mass = masses.find(Text(*link, "name"));
    const auto* inertial = link->FirstChildElement("inertial");
    if (mass == masses.end() || inertial == nullptr) continue;
    mass->second = Number(*inertial->FirstChildElement("mass"), "value", 0);
  }
  return masses;
}

}  // namespace poise
