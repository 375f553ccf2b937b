// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/bind_dynamics.h"
#include "poise/python/python_robot.h"
#include "poise/python/text.h"
#include "poise/robot/control/stand.h"
#include "poise/robot/finding.h"
#include "poise/robot/urdf/urdf.h"

namespace poise {

namespace {

std::filesystem::path& DataFolderStorage() {
  static std::filesystem::path folder;
  return folder;
}

std::shared_ptr<PythonRobot> LoadPythonRobot(py::handle urdf,
                                             py::handle profile,
                                             py::handle packages) {
  auto robot = std::make_shared<PythonRobot>();
  if (!profile.is_none()) robot->profile_file = AsText(profile, "profile");
  if (!urdf.is_none()) {
    robot->urdf = AsText(urdf, "urdf");
  } else {
    robot->urdf = (DataFolder() / "robot/models/humanoid.urdf").string();
    if (profile.is_none()) {
      robot->profile_file =
          (DataFolder() / "robot/profiles/humanoid.yaml").string();
    }
  }
  robot->packages = AsTexts(packages, "packages");
  const py::gil_scoped_release release;
  if (!robot->profile_file.empty()) {
    robot->profile = LoadProfile(robot->profile_file);
  }
  const UrdfDocument document(robot->urdf, &robot->findings,
                              {robot->packages.begin(), robot->packages.end()});
  robot->robot = std::make_shared<const Robot>(
      MakeStandingRobot(document, robot->profile, &robot->findings));
  robot->tree = std::make_shared<PythonTree>(
      std::shared_ptr<const Tree>(robot->robot, &robot->robot->model.tree));
  return robot;
}

// Reads the argument locked: a dict, or another mapping, from names of joints
// to numbers.
std::map<std::string, double> ReadLocked(py::handle value) {
  if (!py::hasattr(value, "keys") || !py::hasattr(value, "__getitem__")) {
    throw std::invalid_argument("locked is of type " + TypeName(value) +
                                ", must be a dict from names of joints to "
                                "their values, such as {'neck_yaw': 0.1}");
  }
  std::map<std::string, double> values;
  for (const auto& [joint, number] :
       py::dict(py::reinterpret_borrow<py::object>(value))) {
    const std::string joint_name = AsText(joint, "a joint of locked");
    values[joint_name] =
        AsNumber(number, ("locked['" + joint_name + "']").c_str());
  }
  return values;
}

std::shared_ptr<PythonTree> LoadTree(py::handle urdf, py::handle locked) {
  const std::string file = AsText(urdf, "urdf");
  const std::map<std::string, double> values = ReadLocked(locked);
  const py::gil_scoped_release release;
  const UrdfDocument document(file);
  const Tree tree = document.MakeModel().tree;
  for (const auto& [joint, value] : values) {
    if (tree.FindJoint(joint)) continue;
    throw std::invalid_argument("locked has '" + joint +
                                "', must have names of the moving joints of " +
                                file);
  }
  if (values.empty()) {
    return std::make_shared<PythonTree>(std::make_shared<const Tree>(tree));
  }
  return std::make_shared<PythonTree>(
      std::make_shared<const Tree>(document.MakeModel(values).tree));
}

void BindFoot(py::module_* module) {
  py::class_<Foot> foot(*module, "Foot", "A flat sole of a robot.");
  foot.def_readonly("name", &Foot::name, "'left_foot' or 'right_foot'.");
  foot.def_readonly("body", &Foot::body, "The index of its body in the tree.");
  foot.def_readonly("frame", &Foot::frame,
                    "The index of its link in Tree.frame_names.");
  foot.def_property_readonly(
      "X_BC", [](const Foot& self) { return ToArray(self.X_BC); },
      "(4, 4) The pose of the contact frame C in the body: z out of the "
      "ground, x forward.");
  foot.def_property_readonly(
      "size",
      [](const Foot& self) {
        return std::pair(2 * self.half_size.x(), 2 * self.half_size.y());
      },
      "Length and width of the largest rectangle in the sole, m.");
  foot.def_property_readonly(
      "polygon",
      [](const Foot& self) {
        Eigen::MatrixX2d points(self.polygon_C.size(), 2);
        for (size_t i = 0; i < self.polygon_C.size(); ++i) {
          points.row(i) = self.polygon_C[i];
        }
        return ToArray(points);
      },
      "(n, 2) The corners of the sole in C, counterclockwise, m.");
  foot.def("__repr__", [](const Foot& self) {
    return "<poise.Foot " + Repr(self.name) + ", " +
           PrintNumber(2 * self.half_size.x()) + " m long, " +
           PrintNumber(2 * self.half_size.y()) + " m wide>";
  });
}

// Returns one limit of each joint.
py::array LimitsOf(const PythonRobot& self, double JointLimits::*limit) {
  const auto& limits = self.robot->model.limits;
  Eigen::VectorXd values(limits.size());
  for (size_t j = 0; j < limits.size(); ++j) values[j] = limits[j].*limit;
  return ToArray(values);
}

void AddLimits(RobotClass* robot) {
  const std::tuple<const char*, double JointLimits::*, const char*> limits[] = {
      {"lower", &JointLimits::lower, "(joints,) Lower limits, rad or m."},
      {"upper", &JointLimits::upper, "(joints,) Upper limits, rad or m."},
      {"velocity", &JointLimits::velocity,
       "(joints,) Largest speeds, rad/s or m/s."},
      {"effort", &JointLimits::effort,
       "(joints,) Largest torques or forces, N m or N."}};
  for (const auto& [name, limit, doc] : limits) {
    const auto which = limit;
    robot->def_property_readonly(
        name,
        [which](const PythonRobot& self) { return LimitsOf(self, which); },
        doc);
  }
}

void AddParts(RobotClass* robot) {
  robot->def_property_readonly(
      "name", [](const PythonRobot& self) { return self.robot->model.name; },
      "The name in the URDF.");
  robot->def_property_readonly(
      "urdf", [](const PythonRobot& self) { return self.urdf; },
      "The URDF file.");
  robot->def_property_readonly(
      "tree", [](const PythonRobot& self) { return self.tree; },
      "The kinematic tree with its dynamics, a Tree.");
  robot->def_property_readonly(
      "posture",
      [](py::object self) {
        return View(self.cast<PythonRobot&>().robot->q_nominal, self);
      },
      "(nq,) The standing posture: soles on the ground at the world's origin, "
      "facing +x. Read-only, without a copy.");
  robot->def_property_readonly(
      "feet",
      [](py::object self) {
        py::list feet;
        for (const Foot& foot : self.cast<PythonRobot&>().robot->feet) {
          feet.append(py::cast(
              &foot, py::return_value_policy::reference_internal, self));
        }
        return feet;
      },
      "The left Foot, then the right one.");
}

}  // namespace

void SetDataFolder(const std::filesystem::path& folder) {
  DataFolderStorage() = folder;
}

const std::filesystem::path& DataFolder() { return DataFolderStorage(); }

void BindRobot(py::module_* module) {
  module->def(
      "_set_data_folder",
      [](py::handle folder) { SetDataFolder(AsText(folder, "folder")); },
      py::arg("folder"));
  BindFoot(module);
  RobotClass robot(*module, "Robot",
                   "A biped that stands, made from its URDF and its profile."
                   "\n\n"
                   ">>> robot = poise.Robot.load()\n"
                   ">>> robot.name, robot.tree.num_joints, len(robot.feet)\n"
                   "('humanoid', 50, 2)\n");
  robot.def_static(
      "load", LoadPythonRobot, py::arg("urdf") = py::none(),
      py::arg("profile") = py::none(), py::arg("packages") = py::tuple(),
      "Reads a robot from a URDF file, and finds its feet and a posture in "
      "which it stands. Without a file, reads Poise's humanoid.\n\n"
      "profile: a YAML file with facts that the URDF does not contain, see "
      "docs/robots.md. packages: folders in which meshes are searched. Raises "
      "poise.InputError if the file is invalid or the robot cannot stand; "
      "poise.doctor() then says what is wrong. Other threads run meanwhile.");
  AddParts(&robot);
  AddLimits(&robot);
  AddDoctor(&robot);
  TreeClass tree = module->attr("Tree");
  robot.def("__repr__", [](const PythonRobot& self) {
    return "<poise.Robot " + Repr(self.robot->model.name) + ", " +
           Count(self.robot->model.tree.num_joints(), "joint") + ">";
  });
  tree.def_static("load", LoadTree, py::arg("urdf"),
                  py::arg("locked") = py::dict(),
                  "Reads a tree with a floating base from any URDF file, with "
                  "or without feet. locked: joints to fix, with their values, "
                  "rad or m. Raises poise.InputError if the file is invalid.");
}

}  // namespace poise
