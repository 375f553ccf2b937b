// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "poise/math/spatial.h"

/// Lets the compiler do several rounds of the loop that follows at once: no
/// round reads what another one writes.
#if defined(__clang__)
#define POISE_LANES _Pragma("clang loop vectorize(assume_safety)")
#else
#define POISE_LANES _Pragma("GCC ivdep")
#endif

namespace poise {

/// Three numbers, for loops over arrays of them. Eigen's Vector3d would keep
/// the compiler from doing several bodies at once: it vectorizes inside the
/// vector.
struct Vec3 {
  double x, y, z;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(double s, const Vec3& a) noexcept {
  return {s * a.x, s * a.y, s * a.z};
}
inline double Dot(const Vec3& a, const Vec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 Cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// math's SpatialMotion and SpatialForce (or SpatialMomentum) of Vec3, and so
/// without the latters' kinds: a motion or acceleration, and a force or momentum
/// about a named point.
struct Motion3 {
  Vec3 angular, linear;
};
struct Force3 {
  Vec3 angular, linear;
};

inline Motion3 operator+(const Motion3& V, const Motion3& W) noexcept {
  return {V.angular + W.angular, V.linear + W.linear};
}
inline Force3 operator+(const Force3& F, const Force3& G) noexcept {
  return {F.angular + G.angular, F.linear + G.linear};
}
inline Force3 operator-(const Force3& F, const Force3& G) noexcept {
  return {F.angular - G.angular, F.linear - G.linear};
}
inline double Dot(const Motion3& V, const Force3& F) noexcept {
  return Dot(V.angular, F.angular) + Dot(V.linear, F.linear);
}
/// A force about B, taken about P.
inline Force3 Shift(const Vec3& p_PB, const Force3& F) noexcept {
  return {F.angular + Cross(p_PB, F.linear), F.linear};
}

/// A matrix of three rows.
struct Mat3 {
  Vec3 x, y, z;
};

inline Vec3 operator*(const Mat3& A, const Vec3& v) noexcept {
  return {Dot(A.x, v), Dot(A.y, v), Dot(A.z, v)};
}
/// The row a' B.
inline Vec3 RowTimes(const Vec3& a, const Mat3& B) noexcept {
  return a.x * B.x + a.y * B.y + a.z * B.z;
}
inline Mat3 operator*(const Mat3& A, const Mat3& B) noexcept {
  return {RowTimes(A.x, B), RowTimes(A.y, B), RowTimes(A.z, B)};
}
inline Mat3 operator+(const Mat3& A, const Mat3& B) noexcept {
  return {A.x + B.x, A.y + B.y, A.z + B.z};
}
inline Mat3 operator*(double s, const Mat3& A) noexcept {
  return {s * A.x, s * A.y, s * A.z};
}

/// A symmetric matrix.
struct Sym3 {
  double xx, yy, zz, xy, xz, yz;
};

inline Mat3 Full(const Sym3& S) noexcept {
  return {{S.xx, S.xy, S.xz}, {S.xy, S.yy, S.yz}, {S.xz, S.yz, S.zz}};
}
inline Vec3 operator*(const Sym3& S, const Vec3& v) noexcept {
  return Full(S) * v;
}
inline Sym3 operator+(const Sym3& S, const Sym3& T) noexcept {
  return {S.xx + T.xx, S.yy + T.yy, S.zz + T.zz,
          S.xy + T.xy, S.xz + T.xz, S.yz + T.yz};
}
/// R S R'.
inline Sym3 Rotate(const Mat3& R, const Sym3& S) noexcept {
  const Mat3 T = R * Full(S);
  return {Dot(T.x, R.x), Dot(T.y, R.y), Dot(T.z, R.z),
          Dot(T.x, R.y), Dot(T.x, R.z), Dot(T.y, R.z)};
}

inline Eigen::Vector3d ToEigen(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Eigen::Matrix3d ToEigen(const Mat3& A) {
  Eigen::Matrix3d result;
  result << A.x.x, A.x.y, A.x.z, A.y.x, A.y.y, A.y.z, A.z.x, A.z.y, A.z.z;
  return result;
}
inline Eigen::Matrix3d ToEigen(const Sym3& S) { return ToEigen(Full(S)); }
inline Vec3 ToVec3(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Force3 ToForce3(const SpatialForce& F) {
  return {ToVec3(F.angular), ToVec3(F.linear)};
}
inline Mat3 ToMat3(const Eigen::Matrix3d& A) {
  return {ToVec3(A.row(0)), ToVec3(A.row(1)), ToVec3(A.row(2))};
}

/// Many Vec3, component by component.
class Vec3Array {
 public:
  explicit Vec3Array(int size = 0) : x_(size), y_(size), z_(size) {}
  Vec3 operator[](int i) const noexcept { return {x_[i], y_[i], z_[i]}; }
  void Set(int i, const Vec3& v) noexcept {
    x_[i] = v.x;
    y_[i] = v.y;
    z_[i] = v.z;
  }

 private:
  std::vector<double> x_, y_, z_;
};

/// Many Force3, component by component.
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

/// Many Mat3, component by component.
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

/// Many Sym3, component by component.
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

}  // namespace poise
