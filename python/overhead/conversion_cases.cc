// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <Eigen/Core>
#include <memory>

#include "poise/dynamics/conventions.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/recursion.h"
#include "poise/dynamics/tree.h"
#include "poise/math/spatial.h"
#include "poise/python/overhead/cases.h"

namespace poise {
namespace {

constexpr Library kLibrary = Library::kMujoco;

// The arguments of all calls, as in measure.py, and memory for their results.
struct Work {
  explicit Work(const Robot& robot)
      : tree(robot.model.tree),
        q(tree.nq()),
        q_library(ConfigurationSize(kLibrary, tree)),
        v(Eigen::VectorXd::LinSpaced(tree.nv(), -1, 1)),
        vdot(-v),
        vector(tree.nv()),
        M(tree.nv(), tree.nv()),
        matrix(tree.nv(), tree.nv()),
        J(Matrix6Xd::Ones(6, tree.nv())),
        jacobian(6, tree.nv()) {
    Integrate(tree, robot.q_nominal, v, 0.3, q);
    ExportConfiguration(kLibrary, tree, q, q_library);
    Recursion recursion(tree);
    ComputeCrba(tree, q, &recursion, M);
  }

  const Tree& tree;
  Eigen::VectorXd q, q_library, v, vdot, vector;
  Eigen::MatrixXd M, matrix;
  Matrix6Xd J, jacobian;
};

using Shared = std::shared_ptr<Work>;

void AddOfState(const Shared& w, std::vector<TimedCase>* cases) {
  const Tree& tree = w->tree;
  cases->push_back({"Tree.export_configuration", [w, &tree] {
                      ExportConfiguration(kLibrary, tree, w->q, w->q_library);
                    }});
  cases->push_back({"Tree.import_configuration", [w, &tree] {
                      ImportConfiguration(kLibrary, tree, w->q_library, w->q);
                    }});
  cases->push_back({"Tree.export_velocity", [w, &tree] {
                      ExportVelocity(kLibrary, tree, w->q, w->v, w->vector);
                    }});
  cases->push_back({"Tree.import_velocity", [w, &tree] {
                      ImportVelocity(kLibrary, tree, w->q, w->v, w->vector);
                    }});
  cases->push_back({"Tree.export_acceleration", [w, &tree] {
                      ExportAcceleration(kLibrary, tree, w->q, w->v, w->vdot,
                                         w->vector);
                    }});
  cases->push_back({"Tree.import_acceleration", [w, &tree] {
                      ImportAcceleration(kLibrary, tree, w->q, w->v, w->vdot,
                                         w->vector);
                    }});
}

void AddOfForces(const Shared& w, std::vector<TimedCase>* cases) {
  const Tree& tree = w->tree;
  cases->push_back({"Tree.export_forces", [w, &tree] {
                      ExportForces(kLibrary, tree, w->q, w->v, w->vector);
                    }});
  cases->push_back({"Tree.import_forces", [w, &tree] {
                      ImportForces(kLibrary, tree, w->q, w->v, w->vector);
                    }});
  cases->push_back({"Tree.export_bias", [w, &tree] {
                      ExportBias(kLibrary, tree, w->q, w->v, w->M, w->vdot,
                                 w->vector);
                    }});
  cases->push_back({"Tree.import_bias", [w, &tree] {
                      ImportBias(kLibrary, tree, w->q, w->v, w->M, w->vdot,
                                 w->vector);
                    }});
}

void AddOfMatrices(const Shared& w, std::vector<TimedCase>* cases) {
  const Tree& tree = w->tree;
  cases->push_back({"Tree.export_mass_matrix", [w, &tree] {
                      ExportMassMatrix(kLibrary, tree, w->q, w->M, w->matrix);
                    }});
  cases->push_back({"Tree.import_mass_matrix", [w, &tree] {
                      ImportMassMatrix(kLibrary, tree, w->q, w->M, w->matrix);
                    }});
  cases->push_back({"Tree.export_jacobian", [w, &tree] {
                      ExportJacobian(kLibrary, tree, w->q, w->J, w->jacobian);
                    }});
  cases->push_back({"Tree.import_jacobian", [w, &tree] {
                      ImportJacobian(kLibrary, tree, w->q, w->J, w->jacobian);
                    }});
}

}  // namespace

void AddConversionCases(const Robot& robot, std::vector<TimedCase>* cases) {
  const auto work = std::make_shared<Work>(robot);
  AddOfState(work, cases);
  AddOfForces(work, cases);
  AddOfMatrices(work, cases);
}

}  // namespace poise
