// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/python/add_view.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/bind_dynamics.h"
#include "poise/python/text.h"

namespace poise {
namespace {

void BindFrameTick(py::module_* module) {
  py::class_<FrameTick> frame(
      *module, "FrameTick",
      "The motion of one frame F in a Tick. Arrays are read-only, without a "
      "copy.");
  frame.def_property_readonly(
      "X", [](const FrameTick& self) { return ToArray(self.X_WF); },
      "(4, 4) The pose X_WF in the world. A copy.");
  AddView("V", &FrameTick::V_WF_W,
          "(6,) The velocity [w; v] of the frame's origin in world axes, rad/s "
          "and m/s: J v.",
          &frame);
  AddView("J", &FrameTick::J_WF_W,
          "(6, nv) The Jacobian in world axes at the frame's origin.", &frame);
  AddView("Jdot_v", &FrameTick::Jdot_v,
          "(6,) The classical acceleration at vdot = 0, rad/s2 and m/s2.",
          &frame);
  frame.def("__repr__", [](const FrameTick& self) {
    return "<poise.FrameTick of frame " + std::to_string(self.frame) + ">";
  });
}

// Makes a tick for the frames, or checks that `out` was made for this tree.
std::shared_ptr<Tick> PrepareTick(const PythonTree& self, py::handle frames,
                                  py::handle out) {
  const Tree& tree = self.tree();
  if (out.is_none()) {
    std::vector<int> indices;
    if (!py::isinstance<py::sequence>(frames) ||
        py::isinstance<py::str>(frames)) {
      throw std::invalid_argument("frames is " + Shown(frames) +
                                  ", must be a list of names or indices");
    }
    for (const py::handle frame : frames) {
      indices.push_back(self.FindFrame(frame));
    }
    return std::make_shared<Tick>(tree, indices);
  }
  if (!py::isinstance<Tick>(out)) {
    throw std::invalid_argument("out is " + Shown(out) +
                                ", must be a Tick that tick() returned");
  }
  if (!py::isinstance<py::sequence>(frames) || py::len(frames) > 0) {
    throw std::invalid_argument(
        "frames must be empty if out is given: out has its frames");
  }
  auto tick = out.cast<std::shared_ptr<Tick>>();
  bool fits = tick->N.size() == tree.nv() &&
              static_cast<int>(tick->X_WB.size()) == tree.num_bodies();
  for (const FrameTick& frame : tick->frames) {
    fits = fits && frame.frame < static_cast<int>(tree.frames().size());
  }
  if (!fits) {
    throw std::invalid_argument(
        "out has M of shape " + ShapeText({tick->M.rows(), tick->M.cols()}) +
        ", must be a tick of this tree, with M of shape " +
        ShapeText({tree.nv(), tree.nv()}));
  }
  return tick;
}

std::shared_ptr<Tick> ComputeTickOf(PythonTree* self, py::handle q,
                                    py::handle v, py::handle frames,
                                    py::handle out) {
  const Tree& tree = self->tree();
  const DoubleArray a = AsVector(q, "q", tree.nq());
  const DoubleArray b = AsVector(v, "v", tree.nv());
  const auto q_map = VectorOf(a), v_map = VectorOf(b);
  std::shared_ptr<Tick> tick = PrepareTick(*self, frames, out);
  std::optional<py::gil_scoped_release> release;
  if (self->IsLong<Recursion>()) release.emplace();
  ComputeTick(tree, q_map, v_map, tick.get());
  return tick;
}

}  // namespace

void AddTick(TreeClass* tree) {
  tree->def("tick", ComputeTickOf, py::arg("q"), py::arg("v"),
            py::arg("frames") = py::tuple(), py::arg("out") = py::none(),
            "Returns all dynamics of a control tick at (q, v) as a Tick, with "
            "a FrameTick for each of the frames, given by name or index.\n\n"
            "out: a Tick of an earlier call, which is overwritten and "
            "returned; nothing is then allocated. Above 60 bodies, other "
            "threads run meanwhile, and must not use the same out.");
}

void BindTick(py::module_* module) {
  BindFrameTick(module);
  py::class_<Tick, std::shared_ptr<Tick>> tick(
      *module, "Tick",
      "All dynamics of one control tick, made by Tree.tick(). Arrays are "
      "read-only, without a copy; Tree.tick(..., out=tick) overwrites them.");
  AddView("M", &Tick::M, "(nv, nv) The joint-space inertia.", &tick);
  AddView("N", &Tick::N, "(nv,) The bias forces with gravity.", &tick);
  AddView("c", &Tick::c, "(nv,) The bias forces without gravity.", &tick);
  AddView("com", &Tick::p_WG, "(3,) The center of mass, world, m.", &tick);
  AddView("com_velocity", &Tick::v_WG, "(3,) Its velocity, world, m/s.", &tick);
  AddView("H_G", &Tick::H_G,
          "(6, nv) The centroidal momentum matrix, world axes, about the "
          "center of mass.",
          &tick);
  AddView("H_G_bias", &Tick::H_G_bias,
          "(6,) The rate of the momentum is H_G vdot + H_G_bias.", &tick);
  AddView("L_G", &Tick::L_G,
          "(6,) The centroidal momentum [angular; linear], H_G v.", &tick);
  tick.def_property_readonly(
      "poses",
      [](const Tick& self) {
        py::list poses;
        for (const Pose& X_WB : self.X_WB) poses.append(ToArray(X_WB));
        return poses;
      },
      "The pose (4, 4) of each body in the world. Copies.");
  tick.def_property_readonly(
      "frames",
      [](py::object self) {
        py::list frames;
        for (FrameTick& frame : self.cast<Tick&>().frames) {
          frames.append(py::cast(
              &frame, py::return_value_policy::reference_internal, self));
        }
        return frames;
      },
      "A FrameTick for each frame that Tree.tick() was asked for.");
  tick.def("__repr__", [](const Tick& self) {
    return "<poise.Tick, nv = " + std::to_string(self.N.size()) + ", " +
           Count(static_cast<std::ptrdiff_t>(self.frames.size()), "frame") +
           ">";
  });
}

}  // namespace poise
