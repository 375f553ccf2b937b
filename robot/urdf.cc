// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "robot/urdf.h"

#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d FromUrdf(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Pose FromUrdf(const urdf::Pose& X) {
  const urdf::Rotation& r = X.rotation;
  return {Eigen::Quaterniond(r.w, r.x, r.y, r.z).toRotationMatrix(),
          FromUrdf(X.position)};
}

// URDF gives the inertia about the center of mass, in the axes of a frame
// there; ours has the axes of the link.
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
      throw std::invalid_argument("joint '" + joint.name +
                                  "': its type is floating or planar, must be "
                                  "revolute, continuous, prismatic or fixed");
  }
}

JointLimits LimitsOf(const urdf::Joint& joint) {
  JointLimits limits{-kInfinity, kInfinity, kInfinity, kInfinity};
  if (joint.limits != nullptr) {
    limits.velocity = joint.limits->velocity;
    limits.effort = joint.limits->effort;
    if (joint.type != urdf::Joint::CONTINUOUS) {
      limits.lower = joint.limits->lower;
      limits.upper = joint.limits->upper;
    }
  }
  if (joint.dynamics != nullptr) {
    limits.damping = joint.dynamics->damping;
    limits.friction = joint.dynamics->friction;
  }
  return limits;
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

// A massless root that carries one floating joint is no part of the robot.
const urdf::Link& BaseOf(const urdf::ModelInterface& urdf) {
  const urdf::Link& root = *urdf.getRoot();
  const bool stands_for_the_world =
      root.inertial == nullptr && root.child_joints.size() == 1 &&
      root.child_joints[0]->type == urdf::Joint::FLOATING;
  return stands_for_the_world ? *root.child_links[0] : root;
}

}  // namespace

RobotModel LoadUrdf(const std::filesystem::path& file,
                    const std::map<std::string, double>& locked) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  const urdf::ModelInterfaceSharedPtr urdf = urdf::parseURDF(text.str());
  if (!stream || urdf == nullptr) {
    throw std::invalid_argument(file.string() + ": is no URDF");
  }
  const urdf::Link& base = BaseOf(*urdf);
  const bool drops_root = &base != urdf->getRoot().get();

  TreeBuilder builder;
  for (const auto& [name, link] : urdf->links_) {
    if (drops_root && link == urdf->getRoot()) continue;
    builder.AddLink(name, link->inertial != nullptr ? FromUrdf(*link->inertial)
                                                    : Inertia{});
  }
  for (const auto& [name, joint] : urdf->joints_) {
    if (drops_root && joint == base.parent_joint) continue;
    builder.AddJoint({name, FromUrdf(*joint), joint->parent_link_name,
                      joint->child_link_name,
                      FromUrdf(joint->parent_to_joint_origin_transform),
                      FromUrdf(joint->axis)});
  }
  for (const auto& [name, value] : locked) builder.Lock(name, value);

  RobotModel model{urdf->getName(), builder.Build(), {}, {}, {}, {}, 0};
  std::unordered_map<std::string, int> joint_of;
  for (const Joint& joint : model.tree.joints()) {
    joint_of[joint.name] = static_cast<int>(model.limits.size());
    model.limits.push_back(LimitsOf(*urdf->joints_.at(joint.name)));
  }
  for (const Joint& joint : model.tree.joints()) {
    const auto& mimic = urdf->joints_.at(joint.name)->mimic;
    if (mimic == nullptr) continue;
    const auto source = joint_of.find(mimic->joint_name);
    if (source == joint_of.end()) continue;  // Locked.
    model.mimics.push_back({joint_of.at(joint.name), source->second,
                            mimic->multiplier, mimic->offset});
  }
  for (int i = 0; i < static_cast<int>(model.tree.frames().size()); ++i) {
    const std::string& name = model.tree.frames()[i].name;
    if (name == base.name) model.root_frame = i;
    AddShapes(*urdf->links_.at(name), i, &model);
  }
  return model;
}

}  // namespace poise
