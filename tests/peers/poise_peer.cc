// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The adapter of Poise's own solver.
#include "poise/hqp/solver.h"
#include "poise/tests/peers/peer.h"

namespace poise {
namespace {

// As in //tools:hqp. A controller allows 500.
constexpr int kMostIterations = 10000;

class PoisePeer final : public Peer {
 public:
  PoisePeer(int num_variables, const std::vector<LevelCapacity>& capacity)
      : hierarchy_(num_variables, capacity),
        solver_(num_variables, capacity),
        solution_(num_variables, capacity) {
    // As in a controller. No peer finds the nullity of each level.
    solver_.finds_nullity = false;
  }

  // The copy is in the cache, as are the copies that the peers make.
  // In a controller, Stack finds the spans as it writes the rows.
  void Load(const Hierarchy& hierarchy) override {
    hierarchy_ = hierarchy;
    hierarchy_.FindSpans();
  }

  bool Solve() override {
    return solver_.Solve(hierarchy_, &solution_) == Status::kOptimal;
  }

  void Forget() override { solver_.Forget(); }

  void AllowMoreIterations() override {
    solver_.max_iterations = kMostIterations;
  }

  const Eigen::VectorXd& y() const override { return solution_.y; }

 private:
  Hierarchy hierarchy_;
  Solver solver_;
  Solution solution_;
};

}  // namespace

std::unique_ptr<Peer> MakePeer(int num_variables,
                               const std::vector<LevelCapacity>& capacity) {
  return std::make_unique<PoisePeer>(num_variables, capacity);
}

}  // namespace poise
