// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/outline.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "poise/dynamics/kinematics.h"
#include "poise/robot/finding.h"
#include "poise/robot/limits.h"
#include "poise/robot/mesh/mesh_reader.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// A foot has at least this many joints above it, and at most this many bodies
// below it, such as toes.
constexpr int kFewestJoints = 3;
constexpr int kMostToes = 2;
// At most about this many axes of a body are used, so that a body with very
// many shapes does not take long.
constexpr size_t kMostAxes = 64;

// Adds the vertices of a mesh, each once.
void AddMesh(const Shape& shape, const Pose& X_BS, MeshReader* reader,
             Outline* outline) {
  const auto& file = std::get<Mesh>(shape.geometry);
  TriangleMesh mesh;
  try {
    mesh = reader->Read(file);
  } catch (const Refusal& refusal) {
    if (outline->mesh_refusal.empty()) {
      outline->mesh_refusal = "mesh " + std::string(refusal.what());
      outline->mesh_is_missing = !reader->Finds(file);
    }
    return;
  }
  std::vector<Eigen::Vector3f>& points = mesh.vertices;
  const auto key = [](const Eigen::Vector3f& p) {
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::sort(points.begin(), points.end(),
            [&](const auto& a, const auto& b) { return key(a) < key(b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const Eigen::Vector3f& p_S : points) {
    outline->corners.push_back(
        {shape.frame, X_BS * p_S.cast<double>(), 0, /*is_mesh=*/true});
  }
}

// Adds the corners and axes of a shape. A curved rim becomes 16 points. A mesh
// is opened only if there is a reader.
void AddShape(const Shape& shape, const Pose& X_BF, MeshReader* reader,
              Outline* outline) {
  const Pose X_BS = X_BF * shape.X_FS;
  const auto add = [&](const Vector3d& p_S, double radius) {
    outline->corners.push_back({shape.frame, X_BS * p_S, radius});
  };
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      add(0.5 * box->size.cwiseProduct(sign), 0);
    }
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.geometry)) {
    constexpr int kPoints = 16;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2 * M_PI * i / kPoints;
      for (const double end : {-0.5, 0.5}) {
        add({cylinder->radius * std::cos(angle),
             cylinder->radius * std::sin(angle), end * cylinder->length},
            0);
      }
    }
  } else if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
    add(Vector3d::Zero(), sphere->radius);
    return;  // The axes of a sphere have no meaning.
  } else {
    if (reader == nullptr) return;
    AddMesh(shape, X_BS, reader, outline);
  }
  if (outline->axes_B.size() >= kMostAxes) return;
  for (int i = 0; i < 3; ++i) outline->axes_B.push_back(X_BS.R.col(i));
}

// Returns the bodies that can be feet, the lowest first, so that the bounds of
// the MeshReader do not stop it before the feet.
std::vector<int> CandidateFeet(const RobotModel& model) {
  const Tree& tree = model.tree;
  std::vector<int> above(tree.num_bodies(), 0);
  std::vector<int> below(tree.num_bodies(), 0);
  for (int b = 1; b < tree.num_bodies(); ++b) {
    above[b] = above[tree.joints()[b - 1].parent] + 1;
  }
  for (int b = tree.num_bodies() - 1; b > 0; --b) {
    below[tree.joints()[b - 1].parent] += below[b] + 1;
  }
  std::vector<Pose> X_WB(tree.num_bodies());
  ComputePoses(tree, RestConfiguration(model), &X_WB);
  std::vector<int> bodies;
  for (int b = 1; b < tree.num_bodies(); ++b) {
    if (above[b] >= kFewestJoints && below[b] <= kMostToes) bodies.push_back(b);
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](int a, int b) { return X_WB[a].p.z() < X_WB[b].p.z(); });
  return bodies;
}

// Adds the shapes of bodies whose outline has no corner yet.
//
// @param bodies  the bodies, in the order in which their meshes are opened.
void AddShapes(const RobotModel& model, const std::vector<Shape>& shapes,
               const std::vector<int>& feet, MeshReader* reader,
               std::vector<Outline>* outlines) {
  std::vector<std::vector<const Shape*>> of_body(outlines->size());
  for (const Shape& shape : shapes) {
    const int body = model.tree.frames()[shape.frame].body;
    if ((*outlines)[body].corners.empty()) of_body[body].push_back(&shape);
  }
  const auto add = [&](int body, MeshReader* of_meshes) {
    for (const Shape* shape : of_body[body]) {
      AddShape(*shape, model.tree.frames()[shape->frame].X_BF, of_meshes,
               &(*outlines)[body]);
    }
    of_body[body].clear();
  };
  for (const int body : feet) add(body, reader);
  for (int body = 0; body < model.tree.num_bodies(); ++body) add(body, nullptr);
}

Outline EmptyOutline() {
  Outline outline;
  for (int i = 0; i < 3; ++i) outline.axes_B.push_back(Vector3d::Unit(i));
  return outline;
}

}  // namespace

std::vector<Outline> MakeOutlines(const RobotModel& model) {
  std::vector<Outline> outlines(model.tree.num_bodies(), EmptyOutline());
  const std::vector<int> feet = CandidateFeet(model);
  MeshReader reader(model.mesh_places);
  for (const std::vector<Shape>* shapes : {&model.collisions, &model.visuals}) {
    AddShapes(model, *shapes, feet, &reader, &outlines);
  }
  return outlines;
}

Outline MakeVisualOutline(const RobotModel& model, int body) {
  Outline outline = EmptyOutline();
  MeshReader reader(model.mesh_places);
  for (const Shape& shape : model.visuals) {
    const Frame& frame = model.tree.frames()[shape.frame];
    if (frame.body == body) AddShape(shape, frame.X_BF, &reader, &outline);
  }
  return outline;
}

}  // namespace poise
