// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <optional>
#include <stdexcept>
#include <string>

#include "poise/dynamics/conventions.h"
#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind_dynamics.h"

namespace poise {
namespace {

Library ToLibrary(py::handle library) {
  const std::string name = AsText(library, "library");
  if (name == "pinocchio") return Library::kPinocchio;
  if (name == "drake") return Library::kDrake;
  if (name == "mujoco") return Library::kMujoco;
  throw std::invalid_argument("library is '" + name +
                              "', must be 'pinocchio', 'drake' or 'mujoco'");
}

void AddConfiguration(TreeClass* tree) {
  tree->def(
      "export_configuration",
      [](const PythonTree& self, py::handle library, py::handle q) {
        const Tree& of = self.tree();
        const Library to = ToLibrary(library);
        const DoubleArray a = AsVector(q, "q", of.nq());
        py::array_t<double> out = NewVector(ConfigurationSize(to, of));
        ExportConfiguration(to, of, VectorOf(a), Writable(&out));
        return out;
      },
      py::arg("library"), py::arg("q"),
      "Returns q (nq,) as 'pinocchio', 'drake' or 'mujoco' has it: a "
      "continuous joint has two entries in Pinocchio. docs/coming_from.md has "
      "the conventions. The joints keep their order.");
  tree->def(
      "import_configuration",
      [](const PythonTree& self, py::handle library, py::handle q) {
        const Tree& of = self.tree();
        const Library from = ToLibrary(library);
        const DoubleArray a = AsVector(q, "q", ConfigurationSize(from, of));
        py::array_t<double> out = NewVector(of.nq());
        ImportConfiguration(from, of, VectorOf(a), Writable(&out));
        return out;
      },
      py::arg("library"), py::arg("q"),
      "Returns Poise's q (nq,) of the q of another library, the inverse of "
      "export_configuration().");
}

// Adds a conversion of a vector (nv,) at the configuration q of Poise.
template <typename Convert>
void AddOfVector(const char* name, const char* argument, Convert convert,
                 const char* doc, TreeClass* tree) {
  tree->def(
      name,
      [convert, argument](const PythonTree& self, py::handle library,
                          py::handle q, py::handle value) {
        const Tree& of = self.tree();
        const DoubleArray a = AsVector(q, "q", of.nq());
        const DoubleArray b = AsVector(value, argument, of.nv());
        py::array_t<double> out = NewVector(of.nv());
        convert(ToLibrary(library), of, VectorOf(a), VectorOf(b),
                Writable(&out));
        return out;
      },
      py::arg("library"), py::arg("q"), py::arg(argument), doc);
}

// Adds a conversion of an acceleration, which needs the velocity as well.
template <typename Convert>
void AddOfAcceleration(const char* name, Convert convert, const char* doc,
                       TreeClass* tree) {
  tree->def(
      name,
      [convert](const PythonTree& self, py::handle library, py::handle q,
                py::handle v, py::handle vdot) {
        const Tree& of = self.tree();
        const DoubleArray a = AsVector(q, "q", of.nq());
        const DoubleArray b = AsVector(v, "v", of.nv());
        const DoubleArray c = AsVector(vdot, "vdot", of.nv());
        py::array_t<double> out = NewVector(of.nv());
        convert(ToLibrary(library), of, VectorOf(a), VectorOf(b), VectorOf(c),
                Writable(&out));
        return out;
      },
      py::arg("library"), py::arg("q"), py::arg("v"), py::arg("vdot"), doc);
}

// Adds a conversion of bias forces, which needs v and the inertia as well.
template <typename Convert>
void AddOfBias(const char* name, Convert convert, const char* doc,
               TreeClass* tree) {
  tree->def(
      name,
      [convert](const PythonTree& self, py::handle library, py::handle q,
                py::handle v, py::handle M, py::handle N) {
        const Tree& of = self.tree();
        const DoubleArray a = AsVector(q, "q", of.nq());
        const DoubleArray b = AsVector(v, "v", of.nv());
        const Eigen::MatrixXd inertia =
            MatrixOf(AsArray(M, "M", {of.nv(), of.nv()}));
        const DoubleArray c = AsVector(N, "N", of.nv());
        const Library other = ToLibrary(library);
        const auto q_map = VectorOf(a), v_map = VectorOf(b),
                   N_map = VectorOf(c);
        py::array_t<double> out = NewVector(of.nv());
        auto out_map = Writable(&out);
        std::optional<py::gil_scoped_release> release;
        if (self.IsLong<Recursion>()) release.emplace();
        convert(other, of, q_map, v_map, inertia, N_map, out_map);
        return out;
      },
      py::arg("library"), py::arg("q"), py::arg("v"), py::arg("M"),
      py::arg("N"), doc);
}

// Adds a conversion of a matrix with nv columns.
// @param rows  6, or kAny for nv rows.
template <typename Matrix, typename Convert>
void AddOfMatrix(const char* name, const char* argument, py::ssize_t rows,
                 Convert convert, const char* doc, TreeClass* tree) {
  tree->def(
      name,
      [convert, argument, rows](const PythonTree& self, py::handle library,
                                py::handle q, py::handle value) {
        const Tree& of = self.tree();
        const DoubleArray a = AsVector(q, "q", of.nq());
        const DoubleArray b =
            AsArray(value, argument, {rows == kAny ? of.nv() : rows, of.nv()});
        const Library other = ToLibrary(library);
        const auto q_map = VectorOf(a);
        const Matrix from = MatrixOf(b);
        Matrix to(from.rows(), from.cols());
        {
          std::optional<py::gil_scoped_release> release;
          if (self.IsLong<Recursion>()) release.emplace();
          convert(other, of, q_map, from, to);
        }
        return ToArray(to);
      },
      py::arg("library"), py::arg("q"), py::arg(argument), doc);
}

}  // namespace

void AddConventions(TreeClass* tree) {
  AddConfiguration(tree);
  AddOfVector("export_velocity", "v", ExportVelocity,
              "Returns v (nv,) as another library has it. q is Poise's.", tree);
  AddOfVector("import_velocity", "v", ImportVelocity,
              "Returns Poise's v (nv,), the inverse of export_velocity(). q is "
              "Poise's.",
              tree);
  AddOfAcceleration("export_acceleration", ExportAcceleration,
                    "Returns vdot (nv,) as another library has it. q and v are "
                    "Poise's.",
                    tree);
  AddOfAcceleration("import_acceleration", ImportAcceleration,
                    "Returns Poise's vdot (nv,), the inverse of "
                    "export_acceleration(). q and v are Poise's.",
                    tree);
  AddOfVector("export_forces", "tau", ExportForces,
              "Returns the generalized forces tau (nv,) as another library has "
              "them. q is Poise's.",
              tree);
  AddOfVector("import_forces", "tau", ImportForces,
              "Returns Poise's generalized forces tau (nv,), the inverse of "
              "export_forces(). q is Poise's.",
              tree);
  AddOfBias("export_bias", ExportBias,
            "Returns the bias forces N (nv,) as another library has them. q, v "
            "and M = crba(q) are Poise's.",
            tree);
  AddOfBias("import_bias", ImportBias,
            "Returns Poise's bias forces N (nv,), the inverse of "
            "export_bias(). q, v and M = crba(q) are Poise's.",
            tree);
  AddOfMatrix<Eigen::MatrixXd>(
      "export_mass_matrix", "M", kAny, ExportMassMatrix,
      "Returns the joint-space inertia M (nv, nv) as another library has it. q "
      "is Poise's.",
      tree);
  AddOfMatrix<Eigen::MatrixXd>(
      "import_mass_matrix", "M", kAny, ImportMassMatrix,
      "Returns Poise's joint-space inertia M (nv, nv), both triangles of the "
      "argument filled. q is Poise's.",
      tree);
  AddOfMatrix<Matrix6Xd>(
      "export_jacobian", "J", 6, ExportJacobian,
      "Returns a Jacobian, or H_G, (6, nv) as another library has it; the rows "
      "keep their axes and point. q is Poise's.",
      tree);
  AddOfMatrix<Matrix6Xd>("import_jacobian", "J", 6, ImportJacobian,
                         "Returns Poise's Jacobian, or H_G, (6, nv), the "
                         "inverse of export_jacobian(). q is Poise's.",
                         tree);
}

}  // namespace poise
