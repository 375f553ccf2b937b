// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/dynamics/dynamics_file.h"

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>

#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tick.h"
#include "poise/math/quaternion.h"
#include "poise/sim/log/parse_json.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

const json& Entry(const json& object, const char* key,
                  const std::string& where) {
  if (!object.contains(key)) {
    throw std::invalid_argument(where + ": has no key '" + key + "'");
  }
  return object[key];
}

const json& Array(const json& object, const char* key,
                  const std::string& where) {
  const json& entry = Entry(object, key, where);
  if (entry.is_array()) return entry;
  throw std::invalid_argument(where + ": '" + key + "' is " + ShowJson(entry) +
                              ", must be an array");
}

VectorXd ReadVector(const json& object, const char* key, int size,
                    const std::string& where) {
  const json& entry = Array(object, key, where);
  const std::string has = where + ": '" + key + "' has ";
  if (static_cast<int>(entry.size()) != size) {
    throw std::invalid_argument(has + Entries(entry.size()) + ", must have " +
                                std::to_string(size));
  }
  VectorXd vector(size);
  for (int i = 0; i < size; ++i) {
    if (!entry[i].is_number() || !std::isfinite(entry[i].get<double>())) {
      throw std::invalid_argument(has + ShowJson(entry[i]) + " at index " +
                                  std::to_string(i) +
                                  ", must be a finite number");
    }
    vector[i] = entry[i];
  }
  return vector;
}

json MatrixToJson(const MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

json VectorToJson(const VectorXd& vector) {
  return std::vector<double>(vector.data(), vector.data() + vector.size());
}

// Returns the index in the tree of each joint, in the order of the file.
std::vector<int> ReadJoints(const Tree& tree, const json& document) {
  const json& names = Array(document, "joints", "document");
  std::vector<int> order;
  std::vector<bool> found(tree.num_joints(), false);
  for (const json& name : names) {
    const auto joint = name.is_string()
                           ? tree.FindJoint(name.get<std::string>())
                           : std::nullopt;
    if (!joint) {
      throw std::invalid_argument("joints: the robot has no joint " +
                                  name.dump());
    }
    if (found[*joint]) {
      throw std::invalid_argument("joints: " + name.dump() +
                                  " is listed twice");
    }
    found[*joint] = true;
    order.push_back(*joint);
  }
  for (int j = 0; j < tree.num_joints(); ++j) {
    if (!found[j]) {
      throw std::invalid_argument("joints: '" + tree.joints()[j].name +
                                  "' is missing");
    }
  }
  return order;
}

// q, v and v̇ in the order of the tree.
struct Motion {
  VectorXd q, v, vdot;
};

Motion ReadMotion(const json& state, const std::vector<int>& order,
                  const std::string& where) {
  const int n = static_cast<int>(order.size());
  const auto read = [&](const char* key, int size) {
    return ReadVector(state, key, size, where);
  };
  const VectorXd wxyz = read("base_quaternion_wxyz", 4);
  if (wxyz.stableNorm() == 0) {
    throw std::invalid_argument(where +
                                ": 'base_quaternion_wxyz' must not be zero");
  }
  // All vectors are read first, because an exception inside Eigen's comma
  // initializer would leave the initializer incomplete.
  const VectorXd p = read("base_position", 3);
  const VectorXd w = read("base_angular_velocity", 3);
  const VectorXd v = read("base_linear_velocity", 3);
  const VectorXd alpha = read("base_angular_acceleration", 3);
  const VectorXd a = read("base_linear_acceleration", 3);
  Motion motion{VectorXd(n + 7), VectorXd(n + 6), VectorXd(n + 6)};
  motion.q.head<7>() << p, QuaternionFromWxyz(wxyz).coeffs();
  motion.q.segment<4>(3).stableNormalize();
  motion.v.head<6>() << w, v;
  motion.vdot.head<6>() << alpha, a;
  const VectorXd q = read("q", n), qd = read("qd", n), qdd = read("qdd", n);
  for (int i = 0; i < n; ++i) {
    motion.q[7 + order[i]] = q[i];
    motion.v[6 + order[i]] = qd[i];
    motion.vdot[6 + order[i]] = qdd[i];
  }
  return motion;
}

std::vector<std::string> FramesOf(const json& state,
                                  const std::vector<std::string>& frames) {
  if (!frames.empty() || !state.contains("frames")) return frames;
  std::vector<std::string> names;
  for (const auto& item : state["frames"].items()) names.push_back(item.key());
  return names;
}

int FindFrame(const Tree& tree, const std::string& name,
              const std::string& where) {
  const auto frame = tree.FindFrame(name);
  if (!frame) {
    throw std::invalid_argument(where + ": the robot has no link '" + name +
                                "'");
  }
  return *frame;
}

void ComputeState(const Tree& tree, const std::vector<int>& order,
                  const std::vector<std::string>& names,
                  const std::string& where, json* state) {
  const Motion motion = ReadMotion(*state, order, where);
  std::vector<int> frames;
  for (const std::string& name : names) {
    frames.push_back(FindFrame(tree, name, where));
  }
  Tick tick(tree, frames);
  ComputeTick(tree, motion.q, motion.v, &tick);
  Recursion scratch(tree);
  VectorXd gravity(tree.nv()), tau(tree.nv());
  ComputeBias(tree, motion.q, VectorXd::Zero(tree.nv()), &scratch, gravity);
  ComputeRnea(tree, motion.q, motion.v, motion.vdot, {}, &scratch, tau);
  if (!(tick.M.allFinite() && tick.N.allFinite() && gravity.allFinite() &&
        tau.allFinite() && tick.L_G.allFinite() && tick.H_G_bias.allFinite())) {
    throw std::invalid_argument(
        where + ": the results are not finite, the numbers must be smaller");
  }

  // P permutes from the order of the tree to the order of the file.
  Eigen::PermutationMatrix<Eigen::Dynamic> P(tree.nv());
  P.setIdentity();
  for (size_t i = 0; i < order.size(); ++i) {
    P.indices()[6 + order[i]] = 6 + static_cast<int>(i);
  }
  (*state)["M"] = MatrixToJson(MatrixXd(P * tick.M * P.transpose()));
  (*state)["bias_h"] = VectorToJson(VectorXd(P * tick.N));
  (*state)["gravity_g"] = VectorToJson(VectorXd(P * gravity));
  (*state)["tau_inverse_dynamics"] = VectorToJson(VectorXd(P * tau));
  (*state)["com"] = VectorToJson(VectorXd(tick.p_WG));
  (*state)["com_velocity"] = VectorToJson(VectorXd(tick.v_WG));
  (*state)["A_G"] = MatrixToJson(MatrixXd(tick.H_G * P.transpose()));
  (*state)["h_G"] = VectorToJson(VectorXd(tick.L_G));
  (*state)["AGdot_nu"] = VectorToJson(VectorXd(tick.H_G_bias));
  (*state)["frames"] = json::object();
  for (size_t i = 0; i < names.size(); ++i) {
    const FrameTick& frame = tick.frames[i];
    (*state)["frames"][names[i]] = {
        {"p", VectorToJson(VectorXd(frame.X_WF.p))},
        {"R", MatrixToJson(MatrixXd(frame.X_WF.R))},
        {"J", MatrixToJson(MatrixXd(frame.J_WF_W * P.transpose()))},
        {"Jdot_nu", VectorToJson(VectorXd(frame.Jdot_v))}};
  }
}

}  // namespace

json ComputeDynamics(const Tree& tree, const json& document,
                     const std::vector<std::string>& frames) {
  if (!document.is_object()) {
    throw std::invalid_argument(
        "is " + ShowJson(document) +
        ", must be an object with the keys joints and states");
  }
  json result = document;
  const std::vector<int> order = ReadJoints(tree, document);
  (void)Array(document, "states", "document");
  result["nv"] = tree.nv();
  result["total_mass"] = tree.total_mass();
  result["root_link"] = tree.frames()[0].name;
  int i = 0;
  for (json& state : result["states"]) {
    const std::string where = "state " + std::to_string(i++);
    if (!state.is_object()) {
      throw std::invalid_argument(where + ": is " + ShowJson(state) +
                                  ", must be an object");
    }
    ComputeState(tree, order, FramesOf(state, frames), where, &state);
  }
  return result;
}

void CheckFrames(const Tree& tree, const std::vector<std::string>& frames) {
  for (const std::string& name : frames) FindFrame(tree, name, "--frames");
}

}  // namespace poise
