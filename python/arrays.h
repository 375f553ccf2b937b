// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "poise/hqp/hierarchy.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

namespace py = pybind11;

/// A dimension of any size, for AsArray().
constexpr py::ssize_t kAny = -1;

/// An argument as float64 in C order. It keeps the memory of its arrays alive.
using DoubleArray = py::array_t<double, py::array::c_style>;

/// Returns an argument of a Python call as an array of this shape. An array of
/// NumPy with dtype float64 in C order is not copied; any other array, list or
/// tuple of numbers is. NaN and infinity are valid.
///
/// Throws std::invalid_argument, which Python sees as poise.InputError, if the
/// argument does not hold real numbers or has another shape. The message has
/// both shapes.
DoubleArray AsArray(py::handle value, const char* name,
                    std::initializer_list<py::ssize_t> shape);

/// Returns an argument of shape (size,). See AsArray().
DoubleArray AsVector(py::handle value, const char* name, py::ssize_t size);

/// Returns the entries of an array of one dimension, without a copy.
inline Eigen::Map<const Eigen::VectorXd> VectorOf(const DoubleArray& array) {
  return {array.data(), array.size()};
}

/// Returns the entries of an array of two dimensions, without a copy.
inline Eigen::Map<const RowMajorMatrix> MatrixOf(const DoubleArray& array) {
  return {array.data(), array.shape(0), array.shape(1)};
}

/// Returns a copy of an argument with a fixed shape.
Eigen::Vector3d AsVector3(py::handle value, const char* name);
Vector6d AsVector6(py::handle value, const char* name);
Eigen::Matrix3d AsMatrix3(py::handle value, const char* name);
/// Reads a homogeneous matrix [R p; 0 0 0 1]; its last row is not read.
Pose AsPose(py::handle value, const char* name);
/// Reads None, or an array of shape (bodies, 6) with rows [torque; force].
std::vector<SpatialForce> AsForces(py::handle value, int num_bodies);

/// Makes an array, not initialised, and gives its memory to Eigen. A matrix is
/// in Fortran order, so that the algorithms write into it without a copy.
inline py::array_t<double> NewVector(py::ssize_t size) {
  return py::array_t<double>(size);
}
inline Eigen::Map<Eigen::VectorXd> Writable(py::array_t<double>* array) {
  return {array->mutable_data(), array->size()};
}
using FortranArray = py::array_t<double, py::array::f_style>;
inline FortranArray NewMatrix(py::ssize_t rows, py::ssize_t cols) {
  return FortranArray({rows, cols});
}
inline Eigen::Map<Eigen::MatrixXd> Writable(FortranArray* array) {
  return {array->mutable_data(), array->shape(0), array->shape(1)};
}

/// Returns a copy as a new array: of one dimension for a vector, else of two
/// dimensions in C order.
template <typename Derived>
py::array_t<double> ToArray(const Eigen::MatrixBase<Derived>& values) {
  if constexpr (Derived::ColsAtCompileTime == 1) {
    py::array_t<double> array(values.size());
    Eigen::Map<Eigen::VectorXd>(array.mutable_data(), values.size()) = values;
    return array;
  } else {
    py::array_t<double> array({values.rows(), values.cols()});
    Eigen::Map<RowMajorMatrix>(array.mutable_data(), values.rows(),
                               values.cols()) = values;
    return array;
  }
}

/// Returns the homogeneous matrix [R p; 0 0 0 1] as a new array.
py::array_t<double> ToArray(const Pose& X);

/// Returns an array that shows the memory of a member of `owner`, read-only and
/// without a copy. The array keeps the owner alive.
/// @param data    column-major, or a vector if cols is 0.
py::array View(const double* data, py::ssize_t rows, py::ssize_t cols,
               py::handle owner);

template <int kRows, int kCols>
py::array View(const Eigen::Matrix<double, kRows, kCols>& values,
               py::handle owner) {
  return View(values.data(), values.rows(), kCols == 1 ? 0 : values.cols(),
              owner);
}

/// Returns the Python notation of a shape: "(3,)".
std::string ShapeText(const std::vector<py::ssize_t>& shape);

}  // namespace poise
