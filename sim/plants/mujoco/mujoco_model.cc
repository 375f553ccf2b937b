// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/mujoco/mujoco_model.h"

#include <Eigen/Geometry>
#include <cmath>
#include <locale>
#include <sstream>
#include <variant>

#include "poise/math/quaternion.h"
#include "poise/sim/plants/neighbors.h"

namespace poise {

namespace {

// Radius of the spheres at the corners of a sole, as in Bullet, m.
constexpr double kSoleRadius = 0.005;

// Contacts and limits are as stiff as a step of 1 ms permits. MuJoCo needs a
// time constant of at least two steps; the impedance is near 1.
constexpr const char* kStiff = "solref=\"0.004 1\" solimp=\"0.95 0.99 0.001\"";

// Two geoms collide if the contype of one shares a bit with the conaffinity of
// the other. The first bit is for the ground, the second bit for
// self-collision. Arrays have the entries without and with self-collision.
constexpr const char* kGround = " contype=\"1\" conaffinity=\"1\"";
constexpr const char* kLink[] = {" contype=\"1\" conaffinity=\"0\"",
                                 " contype=\"3\" conaffinity=\"2\""};
constexpr const char* kAboveGround[] = {" contype=\"0\" conaffinity=\"0\"",
                                        " contype=\"2\" conaffinity=\"2\""};

class Xml {
 public:
  Xml() {
    text_.imbue(std::locale::classic());
    text_.precision(17);
  }

  template <typename T>
  Xml& operator<<(const T& value) {
    text_ << value;
    return *this;
  }
  Xml& operator<<(const Eigen::Vector3d& v) {
    return *this << v.x() << ' ' << v.y() << ' ' << v.z();
  }
  // MuJoCo orders a quaternion as w, x, y, z.
  Xml& operator<<(const Eigen::Quaterniond& q) {
    const Eigen::Vector4d wxyz = WxyzFromQuaternion(q);
    return *this << wxyz[0] << ' ' << Eigen::Vector3d(wxyz.tail<3>());
  }
  // Writes the attributes pos and quat.
  Xml& operator<<(const Pose& X) {
    return *this << "pos=\"" << X.p << "\" quat=\"" << Eigen::Quaterniond(X.R)
                 << '"';
  }

  std::string str() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

void WriteGround(const PlantSettings& settings, Xml* xml) {
  const Eigen::Quaterniond R_WG = GroundRotation(settings.ground);
  // MuJoCo uses the larger friction of two geoms. The ground has 0, so the
  // friction of the robot's geoms counts.
  *xml << "<geom type=\"plane\" size=\"0 0 1\" quat=\"" << R_WG
       << "\" friction=\"0 0 0\"" << kGround << "/>\n";
  for (const Board& board : settings.ground.boards) {
    const Pose X_WS{Eigen::AngleAxisd(board.yaw, Eigen::Vector3d::UnitZ())
                        .toRotationMatrix(),
                    board.center_W};
    *xml << "<geom type=\"box\" size=\"" << Eigen::Vector3d(board.size / 2)
         << "\" " << X_WS << " friction=\"0 0 0\"" << kGround << "/>\n";
  }
}

// Writes the type and size of a shape. Returns false for a mesh, which does not
// collide.
bool WriteGeometry(const Geometry& geometry, Xml* xml) {
  if (const auto* sphere = std::get_if<Sphere>(&geometry)) {
    *xml << "<geom type=\"sphere\" size=\"" << sphere->radius << "\" ";
    return true;
  }
  if (const auto* box = std::get_if<Box>(&geometry)) {
    *xml << "<geom type=\"box\" size=\"" << Eigen::Vector3d(box->size / 2)
         << "\" ";
    return true;
  }
  if (const auto* cylinder = std::get_if<Cylinder>(&geometry)) {
    *xml << "<geom type=\"cylinder\" size=\"" << cylinder->radius << ' '
         << cylinder->length / 2 << "\" ";
    return true;
  }
  return false;
}

void WriteShapes(const Robot& robot, int body, bool collides, Xml* xml) {
  bool is_foot = false;
  for (const Foot& foot : robot.feet) {
    if (foot.body != body) continue;
    is_foot = true;
    for (const Eigen::Vector2d& corner : foot.polygon_C) {
      *xml << "<geom type=\"sphere\" size=\"" << kSoleRadius << "\" pos=\""
           << foot.X_BC * Eigen::Vector3d(corner.x(), corner.y(), kSoleRadius)
           << "\"/>\n";
    }
  }
  for (const Shape& shape : robot.model.collisions) {
    const Frame& frame = robot.model.tree.frames()[shape.frame];
    if (frame.body != body || !WriteGeometry(shape.geometry, xml)) continue;
    *xml << frame.X_BF * shape.X_FS;
    // A foot touches the ground only with its sole.
    if (is_foot) *xml << kAboveGround[collides];
    *xml << "/>\n";
  }
}

void WriteJoint(const RobotModel& model, int j, const PlantSettings& settings,
                Xml* xml) {
  const Joint& joint = model.tree.joints()[j];
  const JointLimits& limits = model.limits[j];
  *xml << "<joint type=\""
       << (joint.type == JointType::kPrismatic ? "slide" : "hinge")
       << "\" axis=\"" << joint.axis_F << "\" armature=\"" << joint.armature
       << '"';
  if (settings.joint_damping) {
    *xml << " damping=\"" << limits.damping << "\" frictionloss=\""
         << limits.friction << '"';
    // MuJoCo's default time constant of 20 ms makes dry friction viscous.
    if (limits.friction > 0) *xml << " solreffriction=\"0.004 1\"";
  }
  const bool limited = settings.joint_limits && std::isfinite(limits.lower) &&
                       std::isfinite(limits.upper);
  if (limited) {
    *xml << " limited=\"true\" range=\"" << limits.lower << ' ' << limits.upper
         << "\" solreflimit=\"0.004 1\"";
  }
  *xml << "/>\n";
}

void WriteBody(const Robot& robot, int body, const PlantSettings& settings,
               Xml* xml) {
  const Tree& tree = robot.model.tree;
  const Inertia& M = tree.inertias()[body];
  const Pose X_PB = body == 0 ? Pose{} : tree.joints()[body - 1].X_PF;
  *xml << "<body name=\"body" << body << "\" " << X_PB << ">\n";
  if (body > 0) {
    WriteJoint(robot.model, body - 1, settings, xml);
  } else if (tree.is_floating()) {
    *xml << "<freejoint/>\n";
  }
  const Eigen::Matrix3d& I = M.I_G_B;
  *xml << "<inertial pos=\"" << M.p_BoG_B << "\" mass=\"" << M.mass
       << "\" fullinertia=\"" << Eigen::Vector3d(I.diagonal()) << ' '
       << Eigen::Vector3d(I(0, 1), I(0, 2), I(1, 2)) << "\"/>\n";
  WriteShapes(robot, body, settings.self_collision, xml);
  for (int child = body + 1; child < tree.num_bodies(); ++child) {
    if (tree.joints()[child - 1].parent == body) {
      WriteBody(robot, child, settings, xml);
    }
  }
  *xml << "</body>\n";
}

}  // namespace

std::string MakeMujocoXml(const Robot& robot, const PlantSettings& settings,
                          const std::vector<std::pair<int, int>>& excluded) {
  Xml xml;
  xml << "<mujoco>\n<compiler angle=\"radian\" inertiafromgeom=\"false\"/>\n"
      << "<option timestep=\"" << settings.dt << "\" gravity=\""
      << robot.model.tree.gravity_W()
      << "\" cone=\"elliptic\" impratio=\"100\" solver=\"Newton\" "
         "iterations=\"50\" tolerance=\"1e-12\"/>\n"
      << "<size nconmax=\"500\" njmax=\"2000\"/>\n"
      << "<default><geom " << kStiff << " condim=\"3\" friction=\""
      << settings.friction << " 0 0\"" << kLink[settings.self_collision]
      << "/></default>\n<worldbody>\n";
  WriteGround(settings, &xml);
  WriteBody(robot, 0, settings, &xml);
  xml << "</worldbody>\n<contact>\n";
  std::vector<std::pair<int, int>> pairs = FindNeighbors(robot.model.tree);
  pairs.insert(pairs.end(), excluded.begin(), excluded.end());
  for (const auto& [a, b] : pairs) {
    xml << "<exclude body1=\"body" << a << "\" body2=\"body" << b << "\"/>\n";
  }
  xml << "</contact>\n</mujoco>\n";
  return xml.str();
}

}  // namespace poise
