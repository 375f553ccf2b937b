// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <rapidcheck.h>

#include <Eigen/Core>
#include <iosfwd>

#include "poise/math/inertia.h"
#include "poise/math/pose.h"
#include "poise/math/spatial.h"

namespace poise {

// Random inputs of property tests. Numbers are drawn as integers and divided,
// so that they shrink towards 0 and print short.

/// A number in [-bound, bound], a multiple of bound/1000.
rc::Gen<double> Numbers(double bound);

/// A vector of `size` Numbers(bound).
rc::Gen<Eigen::VectorXd> VectorsXd(int size, double bound);

/// A vector of three Numbers(10).
rc::Gen<Eigen::Vector3d> Vectors();

/// A rotation vector of norm at most `bound`. Numerically difficult ones are
/// frequent: of norm 0, 1e-300, 1e-160, 1e-8, 1e-4, sqrt(2.5) +- a little, π -
/// 1e-8 or π, and along an axis.
rc::Gen<Eigen::Vector3d> RotationVectors(double bound);

/// ExpSo3() of RotationVectors(π), which include vectors of norm π.
rc::Gen<Eigen::Matrix3d> Rotations();

/// A pose of Rotations() and Vectors().
rc::Gen<Pose> Poses();

/// A spatial vector of six Numbers(10).
rc::Gen<SpatialMotion> Motions();
rc::Gen<SpatialForce> Forces();

/// The inertia of a physically possible body of 0.01 to 10 kg, sometimes of a
/// point or a rod.
rc::Gen<Inertia> Inertias();

// RapidCheck prints failing cases by these functions.
void showValue(const Pose& X, std::ostream& os);
void showValue(const SpatialMotion& V, std::ostream& os);
void showValue(const SpatialForce& F, std::ostream& os);
void showValue(const Inertia& M, std::ostream& os);

}  // namespace poise
