// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <Eigen/Core>

#include "poise/dynamics/body_arrays.h"
#include "poise/math/spatial.h"

/// POISE_LANES tells the compiler that the iterations of the next loop are
/// independent: no iteration reads what another one writes. The compiler then
/// computes one iteration in each lane of a vector register. A lane is the
/// place of one double; SSE2 has two lanes, AVX2 four, AVX-512 eight. Lanes do
/// not change a result: each iteration computes the same sums in the same
/// order.
///
/// The lanes are worth the following factors, the time of a call with scalar
/// loops divided by its time with lanes:
///
/// | size | function | --config=opt, AVX2 | --config=native, AVX-512 |
/// | 50 joints | ComputeRnea | 2.02 | 1.61 |
/// | 50 joints | ComputeBias | 2.02 | 1.58 |
/// | 50 joints | ComputeCrba | 1.63 | 1.46 |
/// | 50 joints | ComputeCentroidalMomentumMatrix | 1.86 | 1.55 |
/// | 50 joints | ComputeTick, two feet | 1.59 | 1.39 |
/// | 50 joints | ComputeRneaDerivatives | 1.24 | 1.26 |
/// | 50 joints | ComputeAba | 1.14 | 1.08 |
/// | 10 joints | ComputeRnea | 1.65 | 1.31 |
/// | 100 joints | ComputeRnea | 2.04 | 1.69 |
/// | 1000 joints | ComputeRnea | 2.13 | 1.82 |
///
/// The sweeps have a version with AVX2, see math/target_clones.h. It does not
/// fuse a product with a sum, so that it gives the same results as the version
/// with SSE2. For ComputeRnea, the scalar loops of the native build take 0.87
/// of the time of those of the other build, so that its lanes are worth less.
///
/// Measured on one core of an AMD EPYC with AVX-512, by GCC 12.2: the fastest
/// of 15 repetitions, in three runs. 50 joints are the humanoid of
/// robot/models; the other trees are random. Scalar loops are those of
///     bazel run --config=opt
///         --per_file_copt='^dynamics/.*@-fno-tree-loop-vectorize'
///         //tests/benchmarks:dynamics_benchmark
#if defined(__clang__)
#define POISE_LANES _Pragma("clang loop vectorize(assume_safety)")
#else
#define POISE_LANES _Pragma("GCC ivdep")
#endif

namespace poise {

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
/// Shift() returns the force about P that is equal to the force F about B:
///     [n + p_PB x f; f].
inline Force3 Shift(const Vec3& p_PB, const Force3& F) noexcept {
  return {F.angular + Cross(p_PB, F.linear), F.linear};
}

inline Vec3 operator*(const Mat3& A, const Vec3& v) noexcept {
  return {Dot(A.x, v), Dot(A.y, v), Dot(A.z, v)};
}
/// RowTimes() returns the row a' B.
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
/// Rotate() returns R S R'; the product computes each entry once.
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

}  // namespace poise
