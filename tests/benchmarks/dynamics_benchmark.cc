// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Measures the time of the 50-joint humanoid's dynamics, and of MuJoCo, KDL and
// Bullet in the same run. Also measures how the time of inverse dynamics grows
// with the number of bodies.
//
//     bazel run --config=native //tests/benchmarks:dynamics_benchmark
//
// prints the fastest time of each benchmark on one core, and the ratios.

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <cstring>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <memory>
#include <random>
#include <stdexcept>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/derivatives.h"
#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tick.h"
#include "poise/math/so3.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/sim/plants/bullet/bullet_body.h"
#include "poise/sim/plants/mujoco/mujoco_model.h"
#include "poise/tests/util/bullet_tree.h"
#include "poise/tests/util/compare_times.h"
#include "poise/tests/util/kdl_tree.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Each iteration uses another state, so that caches and branch prediction
// cannot adapt to one.
constexpr int kStates = 64;

struct States {
  explicit States(const Tree& tree) {
    std::mt19937 draw(1);
    for (int i = 0; i < kStates; ++i) {
      q.push_back(MakeRandomConfiguration(tree, &draw));
      v.push_back(MakeRandomVector(tree.nv(), &draw));
    }
  }
  std::vector<VectorXd> q, v;
};

const Tree& Humanoid() {
  static const Tree tree = LoadUrdf("robot/models/humanoid.urdf").tree;
  return tree;
}

// Runs f(q, v) over the states of the humanoid.
template <typename Function>
void Run(benchmark::State& state, const Tree& tree, Function f) {
  const States states(tree);
  int i = 0;
  for (auto _ : state) {
    f(states.q[i], states.v[i]);
    i = (i + 1) % kStates;
  }
}

void BM_Tick(benchmark::State& state) {
  const Tree& tree = Humanoid();
  Tick tick(tree, {*tree.FindFrame("l_sole"), *tree.FindFrame("r_sole")});
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeTick(tree, q, v, &tick);
  });
}
BENCHMARK(BM_Tick);

void BM_Bias(benchmark::State& state) {
  const Tree& tree = Humanoid();
  Recursion scratch(tree);
  VectorXd N(tree.nv());
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeBias(tree, q, v, &scratch, N);
  });
}
BENCHMARK(BM_Bias);

void BM_Rnea(benchmark::State& state) {
  const Tree& tree = Humanoid();
  Recursion scratch(tree);
  VectorXd tau(tree.nv());
  const std::vector<SpatialForce> none;
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeRnea(tree, q, v, v, none, &scratch, tau);
  });
}
BENCHMARK(BM_Rnea);

void BM_Crba(benchmark::State& state) {
  const Tree& tree = Humanoid();
  Recursion scratch(tree);
  MatrixXd M(tree.nv(), tree.nv());
  Run(state, tree, [&](const VectorXd& q, const VectorXd&) {
    ComputeCrba(tree, q, &scratch, M);
  });
}
BENCHMARK(BM_Crba);

// Returns the humanoid for 50 joints, and else a random tree.
Tree TreeOf(int num_joints) {
  std::mt19937 draw(1);
  return num_joints == 50 ? Humanoid() : MakeRandomTree(num_joints, &draw);
}

// The centroidal momentum matrix alone, from the recursion.
void BM_Cmm(benchmark::State& state) {
  const Tree tree = TreeOf(static_cast<int>(state.range(0)));
  Recursion scratch(tree);
  Matrix6Xd H_G(6, tree.nv());
  Run(state, tree, [&](const VectorXd& q, const VectorXd&) {
    ComputeCentroidalMomentumMatrix(tree, q, &scratch, &H_G);
  });
}
BENCHMARK(BM_Cmm)->Arg(50)->Arg(120);

// Same as BM_Cmm, but M is computed and its first six rows are shifted.
void BM_CmmFromM(benchmark::State& state) {
  const Tree tree = TreeOf(static_cast<int>(state.range(0)));
  Recursion scratch(tree);
  MatrixXd M(tree.nv(), tree.nv());
  const Vector6d c = Vector6d::Zero();  // Zero: without the bias.
  CentroidalMomentum out(tree);
  Run(state, tree, [&](const VectorXd& q, const VectorXd&) {
    ComputeCrba(tree, q, &scratch, M);
    // This block of M is the mass times Hat(p_BoG_W).
    const Eigen::Vector3d p_BoG_W = Vee(M.block<3, 3>(0, 3)) / M(3, 3);
    ComputeCentroidalMomentum(M, c, p_BoG_W, &out);
  });
}
BENCHMARK(BM_CmmFromM)->Arg(50)->Arg(120);

// Same as BM_Tick, but without feet: M, N, the momentum matrix and its bias.
void BM_TickWithoutFeet(benchmark::State& state) {
  const Tree& tree = Humanoid();
  Tick tick(tree, {});
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeTick(tree, q, v, &tick);
  });
}
BENCHMARK(BM_TickWithoutFeet);

void BM_Aba(benchmark::State& state) {
  const Tree& tree = Humanoid();
  AbaScratch scratch(tree);
  VectorXd vdot(tree.nv());
  const std::vector<SpatialForce> none;
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    benchmark::DoNotOptimize(ComputeAba(tree, q, v, v, none, &scratch, vdot));
  });
}
BENCHMARK(BM_Aba);

void BM_RneaDerivatives(benchmark::State& state) {
  const Tree& tree = Humanoid();
  RneaDerivatives out(tree);
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeRneaDerivatives(tree, q, v, v, {}, &out);
  });
}
BENCHMARK(BM_RneaDerivatives);

// Random trees of 10, 100 and 1000 joints. The time per body should not grow.
void BM_RneaOfBodies(benchmark::State& state) {
  std::mt19937 draw(1);
  const Tree tree = MakeRandomTree(static_cast<int>(state.range(0)), &draw);
  Recursion scratch(tree);
  VectorXd tau(tree.nv());
  const std::vector<SpatialForce> none;
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    ComputeRnea(tree, q, v, v, none, &scratch, tau);
  });
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_RneaOfBodies)->RangeMultiplier(10)->Range(10, 1000);

// MuJoCo's data of the humanoid.
struct Mujoco {
  Mujoco() {
    const std::string xml =
        MakeMujocoXml(MakeRobot(Humanoid()), PlantSettings(), {});
    auto vfs = std::make_unique<mjVFS>();
    mj_defaultVFS(vfs.get());
    mj_makeEmptyFileVFS(vfs.get(), "robot.xml", static_cast<int>(xml.size()));
    std::memcpy(vfs->filedata[0], xml.data(), xml.size());
    char error[1000] = "";
    model = mj_loadXML("robot.xml", vfs.get(), error, sizeof(error));
    mj_deleteVFS(vfs.get());
    if (model == nullptr) throw std::runtime_error(error);
    data = mj_makeData(model);
  }
  ~Mujoco() {
    mj_deleteData(data);
    mj_deleteModel(model);
  }

  void Set(const VectorXd& q, const VectorXd& v) const {
    std::memcpy(data->qpos, q.data(), sizeof(double) * model->nq);
    std::memcpy(data->qvel, v.data(), sizeof(double) * model->nv);
    std::swap(data->qpos[3], data->qpos[6]);  // Any unit quaternion will do.
  }

  mjModel* model;
  mjData* data;
};

// Same as BM_Tick, but without H_G, its bias and J̇v.
void BM_MujocoTick(benchmark::State& state) {
  const Mujoco mujoco;
  const mjModel* m = mujoco.model;
  mjData* d = mujoco.data;
  const Tree& tree = Humanoid();
  const int feet[] = {tree.frames()[*tree.FindFrame("l_sole")].body + 1,
                      tree.frames()[*tree.FindFrame("r_sole")].body + 1};
  std::vector<double> M(m->nv * m->nv), N(m->nv), J(12 * m->nv);
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    mujoco.Set(q, v);
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_crb(m, d);
    mj_fullM(m, M.data(), d->qM);
    mj_comVel(m, d);
    mj_rne(m, d, 0, N.data());
    for (int k = 0; k < 2; ++k) {
      mj_jacBody(m, d, &J[6 * k * m->nv], &J[(6 * k + 3) * m->nv], feet[k]);
    }
  });
}
BENCHMARK(BM_MujocoTick);

void BM_MujocoBias(benchmark::State& state) {
  const Mujoco mujoco;
  const mjModel* m = mujoco.model;
  mjData* d = mujoco.data;
  std::vector<double> N(m->nv);
  Run(state, Humanoid(), [&](const VectorXd& q, const VectorXd& v) {
    mujoco.Set(q, v);
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_comVel(m, d);
    mj_rne(m, d, 0, N.data());
  });
}
BENCHMARK(BM_MujocoBias);

void BM_MujocoMassMatrix(benchmark::State& state) {
  const Mujoco mujoco;
  const mjModel* m = mujoco.model;
  mjData* d = mujoco.data;
  std::vector<double> M(m->nv * m->nv);
  Run(state, Humanoid(), [&](const VectorXd& q, const VectorXd& v) {
    mujoco.Set(q, v);
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_crb(m, d);
    mj_fullM(m, M.data(), d->qM);
  });
}
BENCHMARK(BM_MujocoMassMatrix);

void BM_KdlRnea(benchmark::State& state) {
  const Tree& tree = Humanoid();
  const KDL::Tree kdl = MakeKdlTree(tree);
  KDL::TreeIdSolver_RNE solver(kdl, KDL::Vector(0, 0, -9.81));
  KDL::JntArray q_kdl(tree.nv()), v_kdl(tree.nv()), tau(tree.nv());
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    // Writes through maps: with AVX, Eigen assumes that KDL's vectors are
    // aligned to 32 bytes, but KDL's library was built without AVX.
    Map<VectorXd>(q_kdl.data.data(), tree.nv()) = q.tail(tree.nv());
    Map<VectorXd>(v_kdl.data.data(), tree.nv()) = v;
    solver.CartToJnt(q_kdl, v_kdl, v_kdl, {}, tau);
  });
}
BENCHMARK(BM_KdlRnea);

// Runs Bullet's InverseDynamics if it is installed. The time includes setting
// the state, which is about a twentieth of it.
template <typename Function>
void RunBullet(benchmark::State& state, Function f) {
  if (!BulletTree::IsHere()) {
    state.SkipWithError(
        "Bullet is not installed: run tools/setup.sh --baselines");
    return;
  }
  const Tree& tree = Humanoid();
  BulletTree bullet(tree);
  const std::vector<SpatialForce> none;
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    bullet.Set(q, v, v, none);
    f(&bullet);
  });
}

void BM_BulletRnea(benchmark::State& state) {
  RunBullet(state, [](BulletTree* b) { b->ComputeInverseDynamics(); });
}
BENCHMARK(BM_BulletRnea);

void BM_BulletMassMatrix(benchmark::State& state) {
  RunBullet(state, [](BulletTree* b) { b->ComputeMassMatrix(); });
}
BENCHMARK(BM_BulletMassMatrix);

void BM_BulletSetState(benchmark::State& state) {
  RunBullet(state, [](BulletTree*) {});
}
BENCHMARK(BM_BulletSetState);

// The articulated-body algorithm of Bullet's own simulation.
void BM_BulletAba(benchmark::State& state) {
  const Tree& tree = Humanoid();
  BulletBody bullet(tree);
  btMultiBody& body = bullet.body();
  btAlignedObjectArray<btScalar> numbers;
  btAlignedObjectArray<btVector3> vectors;
  btAlignedObjectArray<btMatrix3x3> matrices;
  Run(state, tree, [&](const VectorXd& q, const VectorXd& v) {
    bullet.SetState(q, v);
    body.clearForcesAndTorques();
    for (int j = 0; j < tree.num_joints(); ++j) {
      body.addJointTorque(j, v[tree.v_start() + j]);
    }
    body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(
        1e-3, numbers, vectors, matrices, /* isConstraintPass */ false,
        /* jointFeedbackInWorldSpace */ false,
        /* jointFeedbackInJointFrame */ false);
  });
}
BENCHMARK(BM_BulletAba);

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::CompareTimes(argc, argv,
                             {{"BM_Tick", "BM_MujocoTick"},
                              {"BM_Bias", "BM_MujocoBias"},
                              {"BM_Crba", "BM_MujocoMassMatrix"},
                              {"BM_Rnea", "BM_KdlRnea"},
                              {"BM_Rnea", "BM_BulletRnea"},
                              {"BM_Crba", "BM_BulletMassMatrix"},
                              {"BM_Aba", "BM_BulletAba"},
                              {"BM_Cmm/50", "BM_CmmFromM/50"},
                              {"BM_Cmm/120", "BM_CmmFromM/120"},
                              {"BM_RneaOfBodies/100", "BM_RneaOfBodies/10"},
                              {"BM_RneaOfBodies/1000", "BM_RneaOfBodies/10"}});
}
