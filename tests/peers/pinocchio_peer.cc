// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Measures the dynamics of Poise beside those of Pinocchio:
//   pinocchio FILE
// FILE has a tree, see tree_file.h. Prints a line a function: its name, the CPU
// time of Poise and of Pinocchio [us], and the largest relative difference of
// the results (nan if one is NaN), or -1 where they are not compared. Results
// are compared in Pinocchio's conventions, see dynamics/conventions.h.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/compute-all-terms.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "poise/dynamics/aba.h"
#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/conventions.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/derivatives.h"
#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tick.h"
#include "poise/tests/peers/pinocchio_model.h"
#include "poise/tests/peers/thread_time.h"
#include "poise/tests/peers/tree_file.h"
#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

namespace pin = pinocchio;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStates = 64;
constexpr int kRounds = 25;

// Returns the soles of our humanoid, or the last frame twice.
std::vector<int> FindFeet(const Tree& tree) {
  const int last = static_cast<int>(tree.frames().size()) - 1;
  return {tree.FindFrame("l_sole").value_or(last),
          tree.FindFrame("r_sole").value_or(last)};
}

struct State {
  VectorXd q, v, vdot, tau;
};

// Returns the states of Poise, and the same motions in Pinocchio's
// conventions.
std::pair<std::vector<State>, std::vector<State>> MakeStates(const Tree& tree) {
  constexpr Library kPinocchio = Library::kPinocchio;
  std::pair<std::vector<State>, std::vector<State>> states;
  std::mt19937 draw(1);
  for (int i = 0; i < kStates; ++i) {
    State ours = {MakeRandomConfiguration(tree, &draw),
                  MakeRandomVector(tree.nv(), &draw),
                  MakeRandomVector(tree.nv(), &draw),
                  MakeRandomVector(tree.nv(), &draw)};
    State theirs = {VectorXd(ConfigurationSize(kPinocchio, tree)), ours.v,
                    ours.vdot, ours.tau};
    ExportConfiguration(kPinocchio, tree, ours.q, theirs.q);
    ExportVelocity(kPinocchio, tree, ours.q, ours.v, theirs.v);
    ExportAcceleration(kPinocchio, tree, ours.q, ours.v, ours.vdot,
                       theirs.vdot);
    ExportForces(kPinocchio, tree, ours.q, ours.tau, theirs.tau);
    states.first.push_back(std::move(ours));
    states.second.push_back(std::move(theirs));
  }
  return states;
}

using Call = std::function<void(const State&)>;

struct Function {
  const char* name;
  Call ours;
  std::vector<Call> theirs;  // The fastest one counts.
  // Difference of the results of the last calls, with the state of Poise; or
  // none.
  std::function<double(const State&)> difference;
};

double TimeOfCall(const Call& call, const std::vector<State>& states) {
  const double start = ThreadTime();
  for (const State& state : states) call(state);
  return (ThreadTime() - start) / kStates;
}

// Returns the larger number, or NaN if one is NaN, which std::max would hide.
double Larger(double x, double y) { return std::isnan(x) || x > y ? x : y; }

double RelativeDifference(const MatrixXd& x, const MatrixXd& y) {
  return (x - y).norm() / y.norm();
}

// Both libraries take turns, so that a load of the machine slows both.
void Measure(const Function& function, const std::vector<State>& ours,
             const std::vector<State>& theirs) {
  double our_time = std::numeric_limits<double>::infinity(),
         their_time = our_time;
  for (int round = 0; round < kRounds; ++round) {
    our_time = std::min(our_time, TimeOfCall(function.ours, ours));
    for (const Call& call : function.theirs) {
      their_time = std::min(their_time, TimeOfCall(call, theirs));
    }
  }
  double difference = -1;
  for (int i = 0; function.difference && i < kStates; ++i) {
    function.ours(ours[i]);
    for (const Call& call : function.theirs) {
      call(theirs[i]);
      const double now = function.difference(ours[i]);
      difference = Larger(difference, now);
    }
  }
  std::printf("%s %.4f %.4f %.3g\n", function.name, our_time, their_time,
              difference);
}

// The memory that both libraries write to.
struct Workspace {
  Workspace(const Tree& tree, const pin::Model& model,
            const std::vector<int>& feet)
      : recursion(tree),
        aba(tree),
        derivatives(tree),
        tick(tree, feet),
        N(tree.nv()),
        tau(tree.nv()),
        vdot(tree.nv()),
        exported(tree.nv()),
        M(tree.nv(), tree.nv()),
        exported_M(tree.nv(), tree.nv()),
        H_G(6, tree.nv()),
        exported_H_G(6, tree.nv()),
        data(model) {
    for (MatrixXd* matrix : {&dtau_dq, &dtau_dv, &dtau_dvdot}) {
      *matrix = MatrixXd::Zero(tree.nv(), tree.nv());
    }
    J.assign(feet.size(), MatrixXd::Zero(6, tree.nv()));
  }

  Recursion recursion;
  AbaScratch aba;
  RneaDerivatives derivatives;
  Tick tick;
  VectorXd N, tau, vdot, exported;
  MatrixXd M, exported_M;
  Matrix6Xd H_G, exported_H_G;
  std::vector<SpatialForce> no_forces;

  pin::Data data;
  MatrixXd dtau_dq, dtau_dv, dtau_dvdot;
  std::vector<MatrixXd> J;
};

constexpr Library kTheirs = Library::kPinocchio;

Function Rnea(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"RNEA",
          [&tree, w](const State& s) {
            ComputeRnea(tree, s.q, s.v, s.vdot, w->no_forces, &w->recursion,
                        w->tau);
          },
          {[&model, w](const State& s) {
            pin::rnea(model, w->data, s.q, s.v, s.vdot);
          }},
          [&tree, w](const State& s) {
            ExportForces(kTheirs, tree, s.q, w->tau, w->exported);
            return RelativeDifference(w->exported, w->data.tau);
          }};
}

Function Bias(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"bias",
          [&tree, w](const State& s) {
            ComputeBias(tree, s.q, s.v, &w->recursion, w->N);
          },
          {[&model, w](const State& s) {
            pin::nonLinearEffects(model, w->data, s.q, s.v);
          }},
          [&tree, w](const State& s) {
            ComputeCrba(tree, s.q, &w->recursion, w->M);
            ExportBias(kTheirs, tree, s.q, s.v, w->M, w->N, w->exported);
            return RelativeDifference(w->exported, w->data.nle);
          }};
}

Function Crba(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"CRBA",
          [&tree, w](const State& s) {
            ComputeCrba(tree, s.q, &w->recursion, w->M);
          },
          {[&model, w](const State& s) {
             pin::crba(model, w->data, s.q, pin::Convention::LOCAL);
           },
           [&model, w](const State& s) {
             pin::crba(model, w->data, s.q, pin::Convention::WORLD);
           }},
          [&tree, w](const State& s) {
            ExportMassMatrix(kTheirs, tree, s.q, w->M, w->exported_M);
            const MatrixXd theirs = w->data.M.selfadjointView<Eigen::Upper>();
            return RelativeDifference(w->exported_M, theirs);
          }};
}

Function MomentumMatrix(const Tree& tree, const pin::Model& model,
                        Workspace* w) {
  return {"CMM",
          [&tree, w](const State& s) {
            ComputeCentroidalMomentumMatrix(tree, s.q, &w->recursion, &w->H_G);
          },
          {[&model, w](const State& s) {
            pin::computeCentroidalMap(model, w->data, s.q);
          }},
          [&tree, w](const State& s) {
            // The center of mass of Pinocchio is that of the moving bodies.
            if (!tree.is_floating()) return -1.0;
            ExportJacobian(kTheirs, tree, s.q, w->H_G, w->exported_H_G);
            return RelativeDifference(w->exported_H_G, w->data.Ag);
          }};
}

Function Aba(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"ABA",
          [&tree, w](const State& s) {
            (void)ComputeAba(tree, s.q, s.v, s.tau, w->no_forces, &w->aba,
                             w->vdot);
          },
          {[&model, w](const State& s) {
             pin::aba(model, w->data, s.q, s.v, s.tau, pin::Convention::LOCAL);
           },
           [&model, w](const State& s) {
             pin::aba(model, w->data, s.q, s.v, s.tau, pin::Convention::WORLD);
           }},
          [&tree, w](const State& s) {
            ExportAcceleration(kTheirs, tree, s.q, s.v, w->vdot, w->exported);
            return RelativeDifference(w->exported, w->data.ddq);
          }};
}

// The tick of Pinocchio has neither J̇v nor the bias of the momentum.
Function WholeTick(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"whole tick",
          [&tree, w](const State& s) { ComputeTick(tree, s.q, s.v, &w->tick); },
          {[&model, w](const State& s) {
            pin::computeAllTerms(model, w->data, s.q, s.v);
            pin::updateFramePlacements(model, w->data);
            for (size_t k = 0; k < w->J.size(); ++k) {
              pin::getFrameJacobian(model, w->data,
                                    model.frames.size() - w->J.size() + k,
                                    pin::LOCAL_WORLD_ALIGNED, w->J[k]);
            }
          }},
          [&tree, &model, w](const State& s) {
            ExportJacobian(kTheirs, tree, s.q, w->tick.frames.back().J_WF_W,
                           w->exported_H_G);
            const double in_world =
                RelativeDifference(w->exported_H_G, w->J.back());
            // The axes of the frame: a rotation of the same rows.
            const FrameTick& foot = w->tick.frames.back();
            w->H_G.topRows<3>() =
                foot.X_WF.R.transpose() * foot.J_WF_W.topRows<3>();
            w->H_G.bottomRows<3>() =
                foot.X_WF.R.transpose() * foot.J_WF_W.bottomRows<3>();
            ExportJacobian(kTheirs, tree, s.q, w->H_G, w->exported_H_G);
            pin::getFrameJacobian(model, w->data, model.frames.size() - 1,
                                  pin::LOCAL, w->J.back());
            return Larger(in_world,
                          RelativeDifference(w->exported_H_G, w->J.back()));
          }};
}

// Pinocchio adds to its three matrices, so they are set to zero before. They
// are in its own coordinates of the base and are not compared.
Function Derivatives(const Tree& tree, const pin::Model& model, Workspace* w) {
  return {"derivatives of RNEA",
          [&tree, w](const State& s) {
            ComputeRneaDerivatives(tree, s.q, s.v, s.vdot, w->no_forces,
                                   &w->derivatives);
          },
          {[&model, w](const State& s) {
            w->dtau_dq.setZero();
            w->dtau_dv.setZero();
            w->dtau_dvdot.setZero();
            pin::computeRNEADerivatives(model, w->data, s.q, s.v, s.vdot,
                                        w->dtau_dq, w->dtau_dv, w->dtau_dvdot);
          }},
          nullptr};
}

void MeasureAll(const std::string& path) {
  const Tree tree = ReadTree(path);
  const std::vector<int> feet = FindFeet(tree);
  std::vector<Frame> frames;
  for (const int foot : feet) {
    frames.push_back(tree.frames()[foot]);
    frames.back().name += " foot";
  }
  const pin::Model model = MakePinocchioModel(tree, frames);
  Workspace workspace(tree, model, feet);
  const auto [ours, theirs] = MakeStates(tree);
  for (const auto make :
       {Bias, Rnea, Crba, MomentumMatrix, Aba, WholeTick, Derivatives}) {
    Measure(make(tree, model, &workspace), ours, theirs);
  }
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "pinocchio: " << argc - 1 << " arguments, want 1: FILE\n";
    return 2;
  }
  try {
    poise::MeasureAll(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "pinocchio: " << error.what() << "\n";
    return 2;
  }
}
