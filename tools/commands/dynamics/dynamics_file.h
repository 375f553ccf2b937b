// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Computes the dynamics of a robot in the states of a document:
///     joints  [NAME]: every joint of the tree, in the order of q, qd, qdd
///     states  [{base_position, base_quaternion_wxyz, base_angular_velocity,
///               base_linear_velocity, base_angular_acceleration,
///               base_linear_acceleration, q, qd, qdd}]
/// World axes; velocities and accelerations are those of the base's origin, and
/// the accelerations the derivatives of the velocities. The quaternion is
/// normalized. Other keys are ignored, and kept.
///
/// Returns the document with nv, total_mass, root_link, and in each state
///     M, bias_h = N, gravity_g = N at rest, tau_inverse_dynamics = M v̇ + N,
///     com, com_velocity, A_G = H_G, h_G = L_G, AGdot_nu = H_G's bias,
///     frames {NAME: {p, R, J, Jdot_nu}}
/// for v = [base's w; base's v; qd] and matrices as arrays of rows.
///
/// @param tree    with a floating base.
/// @param frames  names of links; if empty, those that a state names itself.
/// Throws std::invalid_argument with one line: which entry, and what is wrong.
nlohmann::json ComputeDynamics(const Tree& tree, const nlohmann::json& document,
                               const std::vector<std::string>& frames);

/// Throws std::invalid_argument with one line if the tree has no link of one of
/// these names.
void CheckFrames(const Tree& tree, const std::vector<std::string>& frames);

}  // namespace poise
