// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "poise/dynamics/tree.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/bind_dynamics.h"
#include "poise/python/python_tree.h"
#include "poise/python/text.h"
#include "poise/robot/finding.h"

namespace poise {

int PythonTree::FindFrame(py::handle frame) const {
  const int size = static_cast<int>(tree_->frames().size());
  if (py::isinstance<py::str>(frame)) {
    const std::string name = AsText(frame, "frame");
    if (const auto index = tree_->FindFrame(name)) return *index;
    std::string names;
    for (const Frame& each : tree_->frames()) {
      names += (names.empty() ? "" : ", ") + each.name;
    }
    throw std::invalid_argument("frame '" + name +
                                "' is unknown, must be one of " + names);
  }
  const double index = AsNumber(frame, "frame");
  if (!(index >= 0 && index < size && index == static_cast<int>(index))) {
    throw std::invalid_argument(
        "frame is " + py::cast<std::string>(py::str(frame)) +
        ", must be a name or an index from 0 to " + std::to_string(size - 1));
  }
  return static_cast<int>(index);
}

namespace {

void AddSizes(TreeClass* tree) {
  tree->def_property_readonly(
      "nq", [](const PythonTree& self) { return self.tree().nq(); },
      "The size of q: joints + 7 with a floating base.");
  tree->def_property_readonly(
      "nv", [](const PythonTree& self) { return self.tree().nv(); },
      "The size of v: joints + 6 with a floating base.");
  tree->def_property_readonly(
      "num_bodies",
      [](const PythonTree& self) { return self.tree().num_bodies(); },
      "The number of bodies; body 0 is the base.");
  tree->def_property_readonly(
      "num_joints",
      [](const PythonTree& self) { return self.tree().num_joints(); },
      "The number of moving joints; joint j moves body j + 1.");
  tree->def_property_readonly(
      "is_floating",
      [](const PythonTree& self) { return self.tree().is_floating(); },
      "Whether the base floats.");
}

void AddFacts(TreeClass* tree) {
  tree->def_property_readonly(
      "joint_names",
      [](const PythonTree& self) {
        std::vector<std::string> names;
        for (const Joint& joint : self.tree().joints()) {
          names.push_back(joint.name);
        }
        return names;
      },
      "The names of the joints, in the order of q and v.");
  tree->def_property_readonly(
      "frame_names",
      [](const PythonTree& self) {
        std::vector<std::string> names;
        for (const Frame& frame : self.tree().frames()) {
          names.push_back(frame.name);
        }
        return names;
      },
      "The names of the frames, one for each link; the root is the first.");
  tree->def_property_readonly(
      "total_mass",
      [](const PythonTree& self) { return self.tree().total_mass(); },
      "The mass of all links, kg.");
  tree->def_property_readonly(
      "gravity",
      [](const PythonTree& self) { return ToArray(self.tree().gravity_W()); },
      "(3,) The acceleration of free fall in world axes, m/s2.");
  tree->def(
      "neutral",
      [](const PythonTree& self) { return ToArray(self.tree().MakeNeutral()); },
      "Returns q (nq,) with all joints at zero and the base at the world's "
      "origin.");
  tree->def(
      "with_base",
      [](const PythonTree& self, py::handle base) {
        const std::string name = AsText(base, "base");
        if (name != "fixed" && name != "floating") {
          throw std::invalid_argument("base is '" + name +
                                      "', must be 'fixed' or 'floating'");
        }
        const py::gil_scoped_release release;
        return std::make_shared<PythonTree>(
            std::make_shared<const Tree>(self.tree().WithBase(
                name == "fixed" ? BaseType::kFixed : BaseType::kFloating)));
      },
      py::arg("base"),
      "Returns this tree on a base that is 'fixed' at the world's origin, as "
      "an arm on a table, so that q and v have the joints only; or on a "
      "'floating' base.");
  tree->def("__repr__", [](const PythonTree& self) {
    const Tree& of = self.tree();
    return "<poise.Tree, " + Count(of.num_joints(), "joint") + ", base " +
           (of.is_floating() ? "floating" : "fixed") + ", " +
           PrintNumber(of.total_mass()) + " kg>";
  });
}

}  // namespace

void BindTree(py::module_* module) {
  BindDynamicsResults(module);
  TreeClass tree(
      *module, "Tree",
      "A kinematic tree and its dynamics. SI units and rad; world axes; the "
      "angular part comes first.\n\n"
      "q = [p_WB; quaternion of R_WB (x, y, z, w); joints], shape (nq,).\n"
      "v = [w_WB; v_WB; joint rates], shape (nv,), is not the rate of q: see "
      "integrate().\n"
      "Arrays of float64 in C order are not copied; other arguments are. A "
      "wrong shape or type raises poise.InputError. NaN gives NaN."
      "\n\n"
      ">>> tree = poise.Robot.load().tree\n"
      ">>> q, v = tree.neutral(), np.zeros(tree.nv)\n"
      ">>> M, N = tree.crba(q), tree.bias(q, v)\n"
      ">>> bool(np.allclose(tree.rnea(q, v, v + 1), M @ (v + 1) + N))\n"
      "True\n");
  AddSizes(&tree);
  AddFacts(&tree);
  AddEquationOfMotion(&tree);
  AddKinematics(&tree);
  AddMomentum(&tree);
  AddDerivatives(&tree);
  AddTick(&tree);
  AddConventions(&tree);
}

}  // namespace poise
