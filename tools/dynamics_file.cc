// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tools/dynamics_file.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "dynamics/rnea.h"
#include "dynamics/tick.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using nlohmann::json;

const json& Entry(const json& object, const char* key,
                  const std::string& where) {
  if (!object.is_object() || !object.contains(key)) {
    throw std::invalid_argument(where + ": there is no '" + key + "'");
  }
  return object[key];
}

VectorXd ReadVector(const json& object, const char* key, int size,
                    const std::string& where) {
  const json& entry = Entry(object, key, where);
  bool is_good = entry.is_array() && static_cast<int>(entry.size()) == size;
  for (const json& number : entry) {
    is_good =
        is_good && number.is_number() && std::isfinite(number.get<double>());
  }
  if (!is_good) {
    throw std::invalid_argument(where + ": '" + key + "' must be " +
                                std::to_string(size) + " finite numbers");
  }
  VectorXd vector(size);
  for (int i = 0; i < size; ++i) vector[i] = entry[i];
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

// By position in the file: the index of the joint in the tree.
std::vector<int> ReadJoints(const Tree& tree, const json& document) {
  const json& names = Entry(document, "joints", "document");
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
      throw std::invalid_argument("joints: " + name.dump() + " is there twice");
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

// q, v and v̇ as the tree has them, of what stands in the order of the file.
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
  // Read before they are put together: a refusal must not leave Eigen's comma
  // list half done.
  const VectorXd p = read("base_position", 3);
  const VectorXd w = read("base_angular_velocity", 3);
  const VectorXd v = read("base_linear_velocity", 3);
  const VectorXd alpha = read("base_angular_acceleration", 3);
  const VectorXd a = read("base_linear_acceleration", 3);
  Motion motion{VectorXd(n + 7), VectorXd(n + 6), VectorXd(n + 6)};
  motion.q.head<7>() << p, wxyz.tail<3>(), wxyz[0];
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

  // From the tree's order to the file's.
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

// A line of a table: a name, its unit, numbers.
std::string Row(const std::string& name, const char* unit,
                const json& numbers) {
  char text[80];
  std::snprintf(text, sizeof(text), "  %-28s %-10s", name.c_str(), unit);
  std::string row = text;
  for (const json& number : numbers) {
    std::snprintf(text, sizeof(text), " %13.6g", number.get<double>());
    row += text;
  }
  return row + "\n";
}

std::string Header(const std::string& title, const char* unit,
                   const std::vector<const char*>& columns) {
  std::string row = Row(title, unit, json::array());
  for (const char* column : columns) {
    char text[32];
    std::snprintf(text, sizeof(text), " %13s", column);
    row.insert(row.size() - 1, text);
  }
  return row;
}

// An entry of v: its name, and the units of its rate, its force, its inertia.
struct Freedom {
  std::string name;
  const char* rate;
  const char* force;
  const char* inertia;
};

std::vector<Freedom> FreedomsOf(const Tree& tree, const json& joints) {
  std::vector<Freedom> all;
  for (const char* name : {"base w_x", "base w_y", "base w_z"}) {
    all.push_back({name, "rad/s", "N m", "kg m2"});
  }
  for (const char* name : {"base v_x", "base v_y", "base v_z"}) {
    all.push_back({name, "m/s", "N", "kg"});
  }
  for (const json& joint : joints) {
    const std::string name = joint.get<std::string>();
    if (tree.joints()[*tree.FindJoint(name)].type == JointType::kPrismatic) {
      all.push_back({name, "m/s", "N", "kg"});
    } else {
      all.push_back({name, "rad/s", "N m", "kg m2"});
    }
  }
  return all;
}

// The columns of a matrix of six rows, a line each.
std::string Columns(const std::vector<Freedom>& freedoms, const json& matrix) {
  std::string text;
  for (size_t j = 0; j < freedoms.size(); ++j) {
    json column = json::array();
    for (const json& row : matrix) column.push_back(row[j]);
    text += Row(freedoms[j].name, freedoms[j].rate, column);
  }
  return text;
}

}  // namespace

json ComputeDynamics(const Tree& tree, const json& document,
                     const std::vector<std::string>& frames) {
  json result = document;
  const std::vector<int> order = ReadJoints(tree, document);
  if (!Entry(document, "states", "document").is_array()) {
    throw std::invalid_argument("document: 'states' must be an array");
  }
  result["nv"] = tree.nv();
  result["total_mass"] = tree.total_mass();
  result["root_link"] = tree.frames()[0].name;
  int i = 0;
  for (json& state : result["states"]) {
    const std::string where = "state " + std::to_string(i++);
    ComputeState(tree, order, FramesOf(state, frames), where, &state);
  }
  return result;
}

void CheckFrames(const Tree& tree, const std::vector<std::string>& frames) {
  for (const std::string& name : frames) FindFrame(tree, name, "--frames");
}

std::string FormatDynamics(const Tree& tree, const json& document) {
  const std::vector<Freedom> freedoms = FreedomsOf(tree, document["joints"]);
  std::string text = document["root_link"].get<std::string>() + ": " +
                     document["nv"].dump() + " degrees of freedom, " +
                     document["total_mass"].dump() +
                     " kg. World axes; angular before linear.\n";
  int i = 0;
  for (const json& state : document["states"]) {
    text += "\nstate " + std::to_string(i++) + "\n";
    text += Row("center of mass", "m", state["com"]);
    text += Row("  its velocity", "m/s", state["com_velocity"]);
    text += Row("momentum about it, h_G", "N m s, N s", state["h_G"]);
    text += Row("  its rate at v̇ = 0", " N m, N", state["AGdot_nu"]);
    text +=
        Header("\n  force and inertia", "of", {"tau", "N", "gravity", "M_jj"});
    for (size_t j = 0; j < freedoms.size(); ++j) {
      const std::string unit =
          std::string(freedoms[j].force) + ", " + freedoms[j].inertia;
      text += Row(freedoms[j].name, unit.c_str(),
                  {state["tau_inverse_dynamics"][j], state["bias_h"][j],
                   state["gravity_g"][j], state["M"][j][j]});
    }
    text += Header("\n  A_G: N m s, N s at a rate of", "1",
                   {"h_x", "h_y", "h_z", "p_x", "p_y", "p_z"});
    text += Columns(freedoms, state["A_G"]);
    for (const auto& frame : state["frames"].items()) {
      text += "\n" + Row(frame.key(), "m", frame.value()["p"]);
      text += Row("  its J̇v", " rad/s2, m/s2", frame.value()["Jdot_nu"]);
      text += Header("  its J: rad/s, m/s at a rate of", "1",
                     {"w_x", "w_y", "w_z", "v_x", "v_y", "v_z"});
      text += Columns(freedoms, frame.value()["J"]);
    }
  }
  return text;
}

}  // namespace poise
