// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/dynamics/tree.h"

namespace poise {

/// Computes the dynamics of a robot in the states of a document:
///     joints  [NAME]: each joint of the tree once, in the order of q, qd, qdd
///     states  [{base_position, base_quaternion_wxyz, base_angular_velocity,
///               base_linear_velocity, base_angular_acceleration,
///               base_linear_acceleration, q, qd, qdd}]
/// Vectors are in world axes. Velocities and accelerations are those of the
/// base's origin. The accelerations are the time derivatives of the velocities.
/// The function normalizes the quaternion. Other keys are copied to the result.
///
/// Returns the document with nv, total_mass and root_link, and with these keys
/// in each state:
///     M, bias_h = N, gravity_g = N at rest, tau_inverse_dynamics = M v̇ + N,
///     com, com_velocity, A_G = H_G, h_G = L_G, AGdot_nu = bias of H_G,
///     frames {NAME: {p, R, J, Jdot_nu}}
/// Here v = [w of the base; v of the base; qd]. Matrices are arrays of rows.
///
/// @param tree    a tree with a floating base.
/// @param frames  names of links. If empty, the links are the keys of "frames"
///                in each state.
/// Throws std::invalid_argument with one line that names the entry and the
/// error.
nlohmann::json ComputeDynamics(const Tree& tree, const nlohmann::json& document,
                               const std::vector<std::string>& frames);

/// Throws std::invalid_argument with one line if a name is not a link of the
/// tree.
void CheckFrames(const Tree& tree, const std::vector<std::string>& frames);

}  // namespace poise
