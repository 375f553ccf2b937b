// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/arrays.h"

#include <stdexcept>

#include "poise/python/arguments.h"

namespace poise {
namespace {

std::string ShapeOf(const py::array& array) {
  return ShapeText({array.shape(), array.shape() + array.ndim()});
}

bool HasShape(const py::array& array,
              std::initializer_list<py::ssize_t> shape) {
  if (array.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
  py::ssize_t i = 0;
  for (const py::ssize_t size : shape) {
    if (size != kAny && array.shape(i) != size) return false;
    ++i;
  }
  return true;
}

[[noreturn]] void RefuseType(const char* name, const std::string& found,
                             std::initializer_list<py::ssize_t> shape) {
  throw std::invalid_argument(std::string(name) + " is " + found +
                              ", must be real numbers of shape " +
                              ShapeText(shape));
}

// Converts anything but an array of float64 in C order.
DoubleArray Convert(py::handle value, const char* name,
                    std::initializer_list<py::ssize_t> shape) {
  const std::string type = TypeName(value);
  if (value.is_none()) RefuseType(name, "None", shape);
  const py::array any = py::array::ensure(value);
  if (!any) RefuseType(name, "not an array but a " + type, shape);
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    // An empty list has dtype float64, and a ragged one dtype object.
    RefuseType(name,
               "a " + type + " of dtype " +
                   py::cast<std::string>(py::str(any.dtype())) + " and shape " +
                   ShapeOf(any),
               shape);
  }
  DoubleArray numbers = DoubleArray::ensure(any);
  if (!numbers) RefuseType(name, "not convertible to float64", shape);
  return numbers;
}

}  // namespace

std::string ShapeText(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (size_t i = 0; i < shape.size(); ++i) {
    text += (i > 0 ? ", " : "") +
            (shape[i] == kAny ? "any" : std::to_string(shape[i]));
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

DoubleArray AsArray(py::handle value, const char* name,
                    std::initializer_list<py::ssize_t> shape) {
  DoubleArray array = py::isinstance<DoubleArray>(value)
                          ? py::reinterpret_borrow<DoubleArray>(value)
                          : Convert(value, name, shape);
  if (!HasShape(array, shape)) {
    throw std::invalid_argument(std::string(name) + " has shape " +
                                ShapeOf(array) + ", must have shape " +
                                ShapeText(shape));
  }
  return array;
}

DoubleArray AsVector(py::handle value, const char* name, py::ssize_t size) {
  return AsArray(value, name, {size});
}

Eigen::Vector3d AsVector3(py::handle value, const char* name) {
  return VectorOf(AsArray(value, name, {3}));
}

Vector6d AsVector6(py::handle value, const char* name) {
  return VectorOf(AsArray(value, name, {6}));
}

Eigen::Matrix3d AsMatrix3(py::handle value, const char* name) {
  return MatrixOf(AsArray(value, name, {3, 3}));
}

Pose AsPose(py::handle value, const char* name) {
  const DoubleArray array = AsArray(value, name, {4, 4});
  const auto X = MatrixOf(array);
  return {X.topLeftCorner<3, 3>(), X.topRightCorner<3, 1>()};
}

std::vector<SpatialForce> AsForces(py::handle value, int num_bodies) {
  std::vector<SpatialForce> forces;
  if (value.is_none()) return forces;
  const DoubleArray array = AsArray(value, "forces", {num_bodies, 6});
  const auto rows = MatrixOf(array);
  for (int body = 0; body < num_bodies; ++body) {
    forces.emplace_back(Vector6d(rows.row(body)));
  }
  return forces;
}

py::array_t<double> ToArray(const Pose& X) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = X.R;
  matrix.topRightCorner<3, 1>() = X.p;
  return ToArray(matrix);
}

py::array View(const double* data, py::ssize_t rows, py::ssize_t cols,
               py::handle owner) {
  constexpr py::ssize_t kSize = sizeof(double);
  py::array view = cols == 0 ? py::array(py::dtype::of<double>(), {rows},
                                         {kSize}, data, owner)
                             : py::array(py::dtype::of<double>(), {rows, cols},
                                         {kSize, kSize * rows}, data, owner);
  py::detail::array_proxy(view.ptr())->flags &=
      ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

}  // namespace poise
