// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/robot_json.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <variant>

#include "poise/tools/commands/report/mesh_json.h"
#include "poise/tools/commands/report/robot_shapes.h"

namespace poise {
namespace {

using nlohmann::json;

// Returns a vector of any length as an array.
template <typename Derived>
json ToJson(const Eigen::MatrixBase<Derived>& vector) {
  json array = json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) array.push_back(vector[i]);
  return array;
}

void SetPose(const Pose& X, json* object) {
  (*object)["p"] = ToJson(X.p);
  (*object)["quat"] = ToJson(Eigen::Quaterniond(X.R).coeffs());
}

json FiniteOrNull(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

const char* Name(JointType type) {
  switch (type) {
    case JointType::kFixed:
      return "fixed";
    case JointType::kRevolute:
      return "revolute";
    case JointType::kContinuous:
      return "continuous";
    case JointType::kPrismatic:
      return "prismatic";
  }
  return "";
}

const char* Name(BodyShapeKind kind) {
  switch (kind) {
    case BodyShapeKind::kBox:
      return "box";
    case BodyShapeKind::kEllipsoid:
      return "ellipsoid";
    case BodyShapeKind::kCylinder:
      return "cylinder";
    case BodyShapeKind::kCapsule:
      return "capsule";
    case BodyShapeKind::kMesh:
      return "mesh";
  }
  return "";
}

// Returns the name of a body. It is the name of the first link in the body,
// which is the child link of the body's joint.
std::string BodyName(const Tree& tree, int body) {
  for (const Frame& frame : tree.frames()) {
    if (frame.body == body && frame.X_BF.p.isZero(0)) return frame.name;
  }
  return "body " + std::to_string(body);
}

json BodiesToJson(const RobotModel& robot) {
  const Tree& tree = robot.tree;
  json bodies = json::array();
  bodies.push_back(
      {{"name", tree.frames()[robot.root_frame].name}, {"parent", -1}});
  for (int j = 0; j < tree.num_joints(); ++j) {
    const Joint& joint = tree.joints()[j];
    json body = {{"name", BodyName(tree, j + 1)},
                 {"parent", joint.parent},
                 {"joint", joint.name},
                 {"type", Name(joint.type)},
                 {"axis", ToJson(joint.axis_F)}};
    SetPose(joint.X_PF, &body);
    bodies.push_back(std::move(body));
  }
  return bodies;
}

json LinksToJson(const Tree& tree) {
  json links = json::array();
  for (const Frame& frame : tree.frames()) {
    json link = {{"name", frame.name}, {"body", frame.body}};
    SetPose(frame.X_BF, &link);
    links.push_back(std::move(link));
  }
  return links;
}

json ShapesToJson(const RobotModel& robot) {
  json shapes = json::array();
  for (const BodyShape& shape : MakeBodyShapes(robot)) {
    json object = {{"body", shape.body},
                   {"kind", Name(shape.kind)},
                   {"size", ToJson(shape.size)},
                   {"rgba", ToJson(shape.rgba)}};
    SetPose(shape.X_BS, &object);
    if (shape.mesh != nullptr) SetMesh(*shape.mesh, &object);
    if (shape.is_stand_in) object["stand_in"] = true;
    shapes.push_back(std::move(object));
  }
  return shapes;
}

// Returns the meshes of the visuals that have not been read.
json UnreadMeshesToJson(const RobotModel& robot) {
  json unread = json::array();
  for (const Shape& shape : robot.visuals) {
    const auto* mesh = std::get_if<Mesh>(&shape.geometry);
    if (mesh == nullptr || mesh->surface != nullptr) continue;
    const Frame& link = robot.tree.frames()[shape.frame];
    json object = {{"body", link.body},
                   {"file", mesh->file},
                   {"scale", ToJson(mesh->scale)},
                   {"rgba", ToJson(shape.rgba)}};
    SetPose(link.X_BF * shape.X_FS, &object);
    unread.push_back(std::move(object));
  }
  return unread;
}

json FeetToJson(const std::vector<Foot>& feet) {
  json array = json::array();
  for (const Foot& foot : feet) {
    json polygon = json::array();
    for (const Eigen::Vector2d& corner : foot.polygon_C) {
      polygon.push_back(ToJson(corner));
    }
    json object = {{"name", foot.name},
                   {"body", foot.body},
                   {"half_size", ToJson(foot.half_size)},
                   {"polygon", polygon}};
    SetPose(foot.X_BC, &object);
    array.push_back(std::move(object));
  }
  return array;
}

json LimitsToJson(const RobotModel& robot) {
  json limits = json::object();
  for (int j = 0; j < robot.tree.num_joints(); ++j) {
    const JointLimits& limit = robot.limits[j];
    limits[robot.tree.joints()[j].name] = {
        {"lower", FiniteOrNull(limit.lower)},
        {"upper", FiniteOrNull(limit.upper)},
        {"velocity", FiniteOrNull(limit.velocity)},
        {"effort", FiniteOrNull(limit.effort)}};
  }
  return limits;
}

}  // namespace

json MakeRobotJson(const Robot& robot) {
  const RobotModel& model = robot.model;
  json object = {
      {"format", "poise-robot-1"},        {"name", model.name},
      {"mass", model.tree.total_mass()},  {"bodies", BodiesToJson(model)},
      {"links", LinksToJson(model.tree)}, {"shapes", ShapesToJson(model)},
      {"feet", FeetToJson(robot.feet)},   {"limits", LimitsToJson(model)}};
  json unread = UnreadMeshesToJson(model);
  if (!unread.empty() && !model.mesh_places.urdf.empty()) {
    object["urdf"] = std::filesystem::absolute(model.mesh_places.urdf).string();
    object["unread_meshes"] = std::move(unread);
  }
  return object;
}

}  // namespace poise
