// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <vector>

namespace poise {

// The types below are members of Tree and of scratch memories, so their sizes
// are public. Their arithmetic is private, see simd/README.md.

/// Vec3 is a vector of three doubles for loops with lanes. Eigen's Vector3d
/// vectorizes inside one vector, which keeps the compiler from giving each body
/// a lane.
struct Vec3 {
  double x, y, z;
};

/// Motion3 is a spatial motion or acceleration, and Force3 a spatial force or
/// momentum, both about a named point. They are SpatialMotion and SpatialForce
/// of math/spatial.h, made of Vec3.
struct Motion3 {
  Vec3 angular, linear;
};
/// See Motion3.
struct Force3 {
  Vec3 angular, linear;
};

/// Mat3 is a 3 x 3 matrix, stored as three rows.
struct Mat3 {
  Vec3 x, y, z;
};

/// Sym3 is a symmetric 3 x 3 matrix, stored as six entries.
struct Sym3 {
  double xx, yy, zz, xy, xz, yz;
};

/// MassMoments are the moments of order 0, 1 and 2 of a body's mass about a
/// point O, with x the position of an element dm from O:
///     m = sum of dm,   h = sum of x dm,   Sigma = sum of x x' dm.
/// Moments about the same point and in the same axes add up. The moment of
/// inertia is I = trace(Sigma) 1 - Sigma.
///
/// Sigma is stored instead of I because accelerations are a linear field,
///     a + A x,   A = [alpha]x + [w]x [w]x,
/// whose force is A Sigma without a gyroscopic term. The shift of Sigma also
/// costs fewer operations than the shift of I.
struct MassMoments {
  double mass;  ///< m, kg.
  Vec3 h;       ///< m p_OG, kg m.
  Sym3 Sigma;   ///< Second moments, kg m2.
};

/// Vec3Array stores one Vec3 for each body as a structure of arrays: all x,
/// then all y, then all z. One load then fills the lanes with the same
/// component of consecutive bodies.
class Vec3Array {
 public:
  explicit Vec3Array(int size = 0)
      : x_(static_cast<size_t>(size)), y_(x_.size()), z_(x_.size()) {}
  Vec3 operator[](int i) const noexcept {
    const auto k = static_cast<size_t>(i);
    return {x_[k], y_[k], z_[k]};
  }
  void Set(int i, const Vec3& v) noexcept {
    const auto k = static_cast<size_t>(i);
    x_[k] = v.x;
    y_[k] = v.y;
    z_[k] = v.z;
  }

 private:
  std::vector<double> x_, y_, z_;
};

/// Force3Array stores one Force3 for each body as a structure of arrays.
class Force3Array {
 public:
  explicit Force3Array(int size = 0) : angular_(size), linear_(size) {}
  Force3 operator[](int i) const noexcept { return {angular_[i], linear_[i]}; }
  void Set(int i, const Force3& F) noexcept {
    angular_.Set(i, F.angular);
    linear_.Set(i, F.linear);
  }

 private:
  Vec3Array angular_, linear_;
};

/// Mat3Array stores one Mat3 for each body as a structure of arrays.
class Mat3Array {
 public:
  explicit Mat3Array(int size = 0) : x_(size), y_(size), z_(size) {}
  Mat3 operator[](int i) const noexcept { return {x_[i], y_[i], z_[i]}; }
  void Set(int i, const Mat3& A) noexcept {
    x_.Set(i, A.x);
    y_.Set(i, A.y);
    z_.Set(i, A.z);
  }

 private:
  Vec3Array x_, y_, z_;
};

/// Sym3Array stores one Sym3 for each body as a structure of arrays.
class Sym3Array {
 public:
  explicit Sym3Array(int size = 0) : diagonal_(size), rest_(size) {}
  Sym3 operator[](int i) const noexcept {
    const Vec3 d = diagonal_[i], r = rest_[i];
    return {d.x, d.y, d.z, r.x, r.y, r.z};
  }
  void Set(int i, const Sym3& S) noexcept {
    diagonal_.Set(i, {S.xx, S.yy, S.zz});
    rest_.Set(i, {S.xy, S.xz, S.yz});
  }

 private:
  Vec3Array diagonal_, rest_;
};

/// MassMomentsArray stores the MassMoments of each body as a structure of
/// arrays.
class MassMomentsArray {
 public:
  explicit MassMomentsArray(int size = 0)
      : mass_(static_cast<size_t>(size)), h_(size), Sigma_(size) {}
  MassMoments operator[](int i) const noexcept {
    return {mass_[static_cast<size_t>(i)], h_[i], Sigma_[i]};
  }
  void Set(int i, const MassMoments& M) noexcept {
    mass_[static_cast<size_t>(i)] = M.mass;
    h_.Set(i, M.h);
    Sigma_.Set(i, M.Sigma);
  }

 private:
  std::vector<double> mass_;
  Vec3Array h_;
  Sym3Array Sigma_;
};

}  // namespace poise
