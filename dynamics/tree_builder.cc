// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "poise/dynamics/simd/mass_moments.h"
#include "poise/dynamics/tree.h"
#include "poise/math/inertia.h"
#include "poise/math/so3.h"

namespace poise {
namespace {

// kRotationTolerance bounds the deviation of a joint's rotation from
// orthonormal. A matrix with six digits passes, a matrix that scales or mirrors
// does not. The nearest rotation replaces a matrix that deviates by more than
// kRotationRounding.
constexpr double kRotationTolerance = 1e-5;
constexpr double kRotationRounding = 1e-14;

template <typename Value>
[[noreturn]] void Refuse(const std::string& thing, const std::string& what,
                         const Value& value, const std::string& wanted) {
  std::ostringstream message;
  message << thing << ": " << what << " is " << value << ", must be " << wanted;
  throw std::invalid_argument(message.str());
}

void CheckFinite(const std::string& thing, const std::string& what,
                 const Eigen::Ref<const Eigen::MatrixXd>& value) {
  for (const double entry : value.reshaped()) {
    if (!std::isfinite(entry)) Refuse(thing, what, entry, "finite");
  }
}

std::string Quote(const char* kind, const std::string& name) {
  return std::string(kind) + " '" + name + "'";
}

Pose Displacement(const JointSpec& joint, double value) {
  if (joint.type == JointType::kPrismatic) {
    return {Eigen::Matrix3d::Identity(), value * joint.axis_F};
  }
  return {Eigen::AngleAxisd(value, joint.axis_F).toRotationMatrix(),
          Eigen::Vector3d::Zero()};
}

// Checks a link and makes its inertia symmetric to the bit.
void CheckLink(const std::string& name, bool is_physical, Inertia* M_L) {
  const Inertia& M = *M_L;
  if (name.empty()) throw std::invalid_argument("a link has no name");
  const std::string link = Quote("link", name);
  CheckFinite(link, "mass", Eigen::Matrix<double, 1, 1>(M.mass));
  if (M.mass < 0) Refuse(link, "mass", M.mass, "zero or positive");
  CheckFinite(link, "center of mass", M.p_BoG_B);
  CheckFinite(link, "inertia", M.I_G_B);
  // Symmetry and sign of the moments are checked for every mass, zero included.
  const InertiaDefect defect = FindDefect({1, M.p_BoG_B, M.I_G_B});
  if (defect == InertiaDefect::kNotSymmetric) {
    throw std::invalid_argument(link + ": inertia must be symmetric");
  }
  M_L->I_G_B = (M.I_G_B + M.I_G_B.transpose()).eval() / 2;
  if (!is_physical) return;
  if (M.mass == 0 && !M.I_G_B.isZero(0)) {
    Refuse(link, "inertia", M.I_G_B.cwiseAbs().maxCoeff(),
           "zero where the mass is");
  }
  if (defect == InertiaDefect::kNotPositive) {
    Refuse(link, "least principal moment", PrincipalMoments(M.I_G_B)[0],
           "zero or positive");
  }
}

JointMaps MakeJointMaps(const std::vector<Joint>& joints) {
  const int num_bodies = static_cast<int>(joints.size()) + 1;
  JointMaps maps(num_bodies);
  maps.R_constant.Set(0, ToMat3(Eigen::Matrix3d::Identity()));
  for (int b = 1; b < num_bodies; ++b) {
    const Joint& joint = joints[b - 1];
    const Eigen::Matrix3d& R_PF = joint.X_PF.R;
    const Eigen::Vector3d axis_P = R_PF * joint.axis_F;
    maps.parent[b] = joint.parent;
    maps.p_PF.Set(b, ToVec3(joint.X_PF.p));
    maps.armature[b] = joint.armature;
    if (joint.type == JointType::kPrismatic) {
      maps.slide_P.Set(b, ToVec3(axis_P));
      maps.R_constant.Set(b, ToMat3(R_PF));
    } else {
      // Rodrigues: R_FB = a a' + sin q [a]x + cos q (1 - a a').
      const Eigen::Matrix3d aa = joint.axis_F * joint.axis_F.transpose();
      maps.turn_P.Set(b, ToVec3(axis_P));
      maps.R_constant.Set(b, ToMat3(R_PF * aa));
      maps.R_sine.Set(b, ToMat3(R_PF * Hat(joint.axis_F)));
      maps.R_cosine.Set(b, ToMat3(R_PF * (Eigen::Matrix3d::Identity() - aa)));
    }
  }
  for (int b = num_bodies - 1; b >= 0; --b) {
    maps.end[b] = std::max(maps.end[b], b + 1);
    int& end_of_parent = maps.end[maps.parent[b]];
    end_of_parent = std::max(end_of_parent, maps.end[b]);
  }
  return maps;
}

// Checks a joint alone, and normalizes its axis and its rotation.
void CheckJoint(JointSpec* joint) {
  if (joint->name.empty()) throw std::invalid_argument("a joint has no name");
  const std::string thing = Quote("joint", joint->name);
  CheckFinite(thing, "rotation", joint->X_PF.R);
  CheckFinite(thing, "position", joint->X_PF.p);
  Eigen::Matrix3d& R = joint->X_PF.R;
  if (!R.isUnitary(kRotationTolerance) || R.determinant() < 0) {
    throw std::invalid_argument(thing + ": rotation must be orthonormal");
  }
  if (!R.isUnitary(kRotationRounding)) R = ProjectToSo3(R);
  if (joint->type == JointType::kFixed) return;
  CheckFinite(thing, "axis", joint->axis_F);
  if (joint->axis_F.isZero(0)) {
    Refuse(thing, "axis", "(0, 0, 0)", "another vector");
  }
  joint->axis_F.stableNormalize();
  CheckFinite(thing, "armature", Eigen::Matrix<double, 1, 1>(joint->armature));
  if (joint->armature < 0) {
    Refuse(thing, "armature", joint->armature, "zero or positive");
  }
}

using Index = std::unordered_map<std::string, int>;

// Returns the index of a name. Throws if the name is unknown.
int Find(const Index& index, const std::string& thing, const char* kind,
         const std::string& name) {
  const auto found = index.find(name);
  if (found == index.end()) {
    throw std::invalid_argument(thing + ": there is no " + Quote(kind, name));
  }
  return found->second;
}

template <typename Item>
Index MakeIndex(const std::vector<Item>& items, const char* kind) {
  Index index;
  for (const Item& item : items) {
    if (!index.emplace(item.name, static_cast<int>(index.size())).second) {
      throw std::invalid_argument(Quote(kind, item.name) + " is there twice");
    }
  }
  return index;
}

// Step 1 of Build() turns a locked joint into a fixed one, by the displacement
// of the joint at its locked value: X_PF becomes X_PF X_FB(value).
void LockJoint(const std::string& name, double value, const Index& joint_index,
               std::vector<JointSpec>* joints) {
  const std::string thing = Quote("joint", name);
  JointSpec& joint = (*joints)[Find(joint_index, "lock", "joint", name)];
  if (joint.type == JointType::kFixed) {
    throw std::invalid_argument(thing + ": it is fixed, or locked twice");
  }
  joint.X_PF = joint.X_PF * Displacement(joint, value);
  joint.type = JointType::kFixed;
}

// Graph stores the tree by indices of links and joints in the order of
// AddLink() and AddJoint().
struct Graph {
  std::vector<std::vector<int>> joints_of;  // By link: joints to its children.
  std::vector<int> joint_above;  // By link: joint to its parent, or -1.
  std::vector<int> parent_of;    // By joint: its parent link.
  std::vector<int> child_of;     // By joint: its child link.
};

// Step 2 of Build() connects the links, none of which may have two parents.
Graph Connect(const Index& links, const std::vector<JointSpec>& joints) {
  Graph graph;
  graph.joints_of.resize(links.size());
  graph.joint_above.assign(links.size(), -1);
  for (size_t j = 0; j < joints.size(); ++j) {
    const std::string thing = Quote("joint", joints[j].name);
    const int parent = Find(links, thing, "link", joints[j].parent);
    const int child = Find(links, thing, "link", joints[j].child);
    int& joint_above = graph.joint_above[child];
    if (joint_above >= 0) {
      throw std::invalid_argument(
          Quote("link", joints[j].child) + " has two parents, by " +
          Quote("joint", joints[joint_above].name) + " and " + thing);
    }
    joint_above = static_cast<int>(j);
    graph.parent_of.push_back(parent);
    graph.child_of.push_back(child);
    graph.joints_of[parent].push_back(static_cast<int>(j));
  }
  return graph;
}

// Step 3 of Build() finds the root, the only link without a parent.
template <typename Link>
int FindRoot(const Graph& graph, const std::vector<Link>& links) {
  int root = -1;
  for (size_t i = 0; i < links.size(); ++i) {
    if (graph.joint_above[i] >= 0) continue;
    if (root >= 0) {
      throw std::invalid_argument("two roots, " +
                                  Quote("link", links[root].name) + " and " +
                                  Quote("link", links[i].name));
    }
    root = static_cast<int>(i);
  }
  if (root < 0) {
    throw std::invalid_argument(links.empty()
                                    ? "there is no link"
                                    : "no root: every link has a parent");
  }
  return root;
}

// Returns the links in depth-first order from the root: parents before
// children, and subtrees contiguous. The explicit stack allows trees of any
// depth.
std::vector<int> DepthFirst(const Graph& graph, int root) {
  std::vector<int> order;
  std::vector<int> stack{root};
  while (!stack.empty()) {
    const int link = stack.back();
    stack.pop_back();
    order.push_back(link);
    const std::vector<int>& below = graph.joints_of[link];
    for (auto j = below.rbegin(); j != below.rend(); ++j) {
      stack.push_back(graph.child_of[*j]);
    }
  }
  return order;
}

}  // namespace

TreeBuilder& TreeBuilder::AddLink(std::string name, const Inertia& M_L) {
  Inertia M = M_L;
  CheckLink(name, physical_inertias_, &M);
  links_.push_back({std::move(name), M});
  return *this;
}

TreeBuilder& TreeBuilder::AcceptUnphysicalInertias() {
  physical_inertias_ = false;
  return *this;
}

TreeBuilder& TreeBuilder::AddJoint(JointSpec joint) {
  CheckJoint(&joint);
  joints_.push_back(std::move(joint));
  return *this;
}

TreeBuilder& TreeBuilder::Lock(std::string joint, double value) {
  CheckFinite(Quote("joint", joint), "locked value",
              Eigen::Matrix<double, 1, 1>(value));
  locks_.push_back({std::move(joint), value});
  return *this;
}

TreeBuilder& TreeBuilder::SetGravity(const Eigen::Vector3d& gravity_W) {
  CheckFinite("tree", "gravity", gravity_W);
  gravity_W_ = gravity_W;
  return *this;
}

Tree TreeBuilder::Build(BaseType base) const {
  const Index links = MakeIndex(links_, "link");
  const Index joint_index = MakeIndex(joints_, "joint");
  std::vector<JointSpec> joints = joints_;
  for (const LockedJoint& lock : locks_) {
    LockJoint(lock.name, lock.value, joint_index, &joints);
  }
  const Graph graph = Connect(links, joints);
  const int root = FindRoot(graph, links_);

  // Step 4 makes bodies and frames. A moving joint starts a body; a fixed one
  // adds its link L to the parent's body B:  X_BL = X_BP X_PF,  M_B += X_BL
  // M_L.
  Tree tree;
  tree.base_ = base;
  tree.gravity_W_ = gravity_W_;
  std::vector<int> frame_of(links_.size(), -1);
  for (const int link : DepthFirst(graph, root)) {
    Frame frame{links_[link].name, 0, {}};
    const int above = graph.joint_above[link];
    if (above < 0) {
      tree.inertias_.push_back(links_[link].M);
    } else {
      const JointSpec& joint = joints[above];
      const Frame& parent = tree.frames_[frame_of[graph.parent_of[above]]];
      const Pose X_BF = parent.X_BF * joint.X_PF;
      if (joint.type == JointType::kFixed) {
        frame.body = parent.body;
        frame.X_BF = X_BF;
        Inertia& M_B = tree.inertias_[parent.body];
        M_B = M_B + X_BF * links_[link].M;
      } else {
        frame.body = static_cast<int>(tree.inertias_.size());
        tree.inertias_.push_back(links_[link].M);
        tree.joints_.push_back({joint.name, joint.type, parent.body, X_BF,
                                joint.axis_F, joint.armature});
      }
    }
    frame_of[link] = static_cast<int>(tree.frames_.size());
    tree.frames_.push_back(std::move(frame));
    tree.total_mass_ += links_[link].M.mass;
  }
  for (size_t i = 0; i < links_.size(); ++i) {
    if (frame_of[i] < 0) {
      throw std::invalid_argument(
          Quote("link", links_[i].name) + " is not connected to the root, " +
          Quote("link", links_[root].name) + ": it is in or below a cycle");
    }
  }

  // Step 5 stores joints and inertias once more, as the recursions read them.
  tree.joint_maps_ = MakeJointMaps(tree.joints_);
  tree.mass_moments_ = MassMomentsArray(tree.num_bodies());
  for (int b = 0; b < tree.num_bodies(); ++b) {
    tree.mass_moments_.Set(b, MakeMassMoments(tree.inertias_[b]));
  }
  return tree;
}

}  // namespace poise
