// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/tree_file.h"

#include <fstream>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>

namespace poise {
namespace {

constexpr char kFormat[] = "poise-tree-1";

std::string BodyName(int body) { return "body " + std::to_string(body); }

// Writes a matrix row by row.
void Write(const Eigen::MatrixXd& matrix, std::ostream* out) {
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) *out << matrix(i, j) << ' ';
  }
}

template <typename Matrix>
void Read(std::istream* in, Matrix* matrix) {
  for (int i = 0; i < matrix->rows(); ++i) {
    for (int j = 0; j < matrix->cols(); ++j) *in >> (*matrix)(i, j);
  }
}

void Write(const Pose& X, std::ostream* out) {
  Write(X.R, out);
  Write(X.p, out);
}

void Read(std::istream* in, Pose* X) {
  Read(in, &X->R);
  Read(in, &X->p);
}

std::string ReadName(std::istream* in) {
  std::string name;
  std::getline(*in >> std::ws, name);
  return name;
}

void ReadBodies(std::istream* in, int count, TreeBuilder* builder) {
  for (int body = 0; body < count; ++body) {
    Inertia M;
    *in >> M.mass;
    Read(in, &M.p_BoG_B);
    Read(in, &M.I_G_B);
    builder->AddLink(BodyName(body), M);
  }
}

void ReadJoints(std::istream* in, int count, TreeBuilder* builder) {
  for (int j = 0; j < count; ++j) {
    JointSpec joint;
    int type = 0, parent = 0;
    *in >> type >> parent >> joint.armature;
    if (type < 0 || type > static_cast<int>(JointType::kPrismatic)) {
      in->setstate(std::ios::failbit);
      return;
    }
    joint.type = static_cast<JointType>(type);
    joint.parent = BodyName(parent);
    joint.child = BodyName(j + 1);
    Read(in, &joint.axis_F);
    Read(in, &joint.X_PF);
    joint.name = ReadName(in);
    builder->AddJoint(joint);
  }
}

// Each frame becomes a link without mass, fixed to its body.
void ReadFrames(std::istream* in, int count, TreeBuilder* builder) {
  for (int frame = 0; frame < count; ++frame) {
    JointSpec joint;
    int body = 0;
    *in >> body;
    Read(in, &joint.X_PF);
    joint.parent = BodyName(body);
    joint.child = ReadName(in);
    joint.name = "fixed " + joint.child;
    builder->AddLink(joint.child).AddJoint(joint);
  }
}

}  // namespace

void WriteTree(const Tree& tree, const std::string& path) {
  std::ofstream out(path);
  out.precision(std::numeric_limits<double>::max_digits10);
  out << kFormat << ' ' << tree.is_floating() << ' ' << tree.num_bodies() << ' '
      << tree.frames().size() << ' ';
  Write(tree.gravity_W(), &out);
  for (const Inertia& M : tree.inertias()) {
    out << '\n' << M.mass << ' ';
    Write(M.p_BoG_B, &out);
    Write(M.I_G_B, &out);
  }
  for (const Joint& joint : tree.joints()) {
    out << '\n'
        << static_cast<int>(joint.type) << ' ' << joint.parent << ' '
        << joint.armature << ' ';
    Write(joint.axis_F, &out);
    Write(joint.X_PF, &out);
    out << joint.name;
  }
  for (const Frame& frame : tree.frames()) {
    out << '\n' << frame.body << ' ';
    Write(frame.X_BF, &out);
    out << frame.name;
  }
  out << '\n';
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

Tree ReadTree(const std::string& path) {
  std::ifstream in(path);
  std::string format;
  bool is_floating = true;
  int bodies = 0, frames = 0;
  Eigen::Vector3d gravity_W = Eigen::Vector3d::Zero();
  in >> format >> is_floating >> bodies >> frames;
  Read(&in, &gravity_W);
  if (!in || format != kFormat) {
    throw std::invalid_argument(path + ": not a file of a tree, want " +
                                kFormat + "; record it again");
  }
  TreeBuilder builder;
  builder.AcceptUnphysicalInertias().SetGravity(gravity_W);
  ReadBodies(&in, bodies, &builder);
  ReadJoints(&in, bodies - 1, &builder);
  ReadFrames(&in, frames, &builder);
  if (!in) {
    throw std::invalid_argument(path +
                                ": ends too early, or has a joint of "
                                "unknown type; record the tree again");
  }
  return builder.Build(is_floating ? BaseType::kFloating : BaseType::kFixed);
}

}  // namespace poise
