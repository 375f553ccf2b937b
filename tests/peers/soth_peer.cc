// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The adapter of SOTH, the hierarchical solver of Escande, Mansard and Wieber.
#include <cmath>
#include <soth/HCOD.hpp>

#include "poise/tests/peers/bounded_rows.h"
#include "poise/tests/peers/peer.h"

namespace poise {
namespace {

soth::Bound ToBound(double lower, double upper) {
  if (lower == upper) return soth::Bound(lower);
  if (!std::isfinite(lower)) {
    return soth::Bound(upper, soth::Bound::BOUND_SUP);
  }
  if (!std::isfinite(upper)) {
    return soth::Bound(lower, soth::Bound::BOUND_INF);
  }
  return soth::Bound(lower, upper);
}

class SothPeer final : public Peer {
 public:
  SothPeer(int num_variables, const std::vector<LevelCapacity>& capacity)
      : num_variables_(num_variables), sides_(NoActiveSides(capacity)) {}

  void Load(const Hierarchy& hierarchy) override {
    std::vector<BoundedRows> problem = ToBoundedRows(hierarchy, &levels_);
    const bool is_new = !solver_ || !HaveSameSizes(problem, problem_);
    problem_ = std::move(problem);
    if (is_new) bounds_.assign(problem_.size(), {});
    for (size_t k = 0; k < problem_.size(); ++k) {
      const BoundedRows& level = problem_[k];
      bounds_[k].resize(level.rows());
      for (int i = 0; i < level.rows(); ++i) {
        bounds_[k][i] = ToBound(level.lower[i], level.upper[i]);
      }
    }
    if (is_new) {
      solver_ = std::make_unique<soth::HCOD>(num_variables_, problem_.size());
      for (size_t k = 0; k < problem_.size(); ++k) {
        solver_->pushBackStage(problem_[k].A, bounds_[k]);
      }
      solver_->setNameByOrder("level");
    }
  }

  bool Solve() override {
    for (size_t k = 0; k < problem_.size(); ++k) {
      solver_->stage(k).set(problem_[k].A, bounds_[k]);
    }
    Activate();
    // SOTH throws an integer after 1000 steps.
    try {
      solver_->activeSearch(y_);
    } catch (int) {
      y_ = solver_->solution;
      solver_.reset();
    }
    ReadActive();
    return solver_ != nullptr;
  }

  void Forget() override { Deactivate(&sides_); }

  const Eigen::VectorXd& y() const override { return y_; }

 private:
  void Activate() {
    for (size_t k = 0; k < problem_.size(); ++k) {
      soth::cstref_vector_t active;
      for (int i = 0; i < problem_[k].rows(); ++i) {
        const int source = problem_[k].source[i];
        if (source < 0) continue;
        const Side side = sides_[levels_[k]][source];
        if (side == Side::kNone) continue;
        active.emplace_back(i, side == Side::kLower ? soth::Bound::BOUND_INF
                                                    : soth::Bound::BOUND_SUP);
      }
      solver_->setInitialActiveSet(active, k);
    }
  }

  // After a solve that failed, the next one starts without active rows.
  void ReadActive() {
    Deactivate(&sides_);
    if (!solver_) return;
    for (size_t k = 0; k < problem_.size(); ++k) {
      for (const soth::ConstraintRef& row : solver_->getOptimalActiveSet(k)) {
        const int source = problem_[k].source[row.row];
        if (source < 0) continue;
        sides_[levels_[k]][source] =
            row.type == soth::Bound::BOUND_INF ? Side::kLower : Side::kUpper;
      }
    }
  }

  int num_variables_;
  std::unique_ptr<soth::HCOD> solver_;  // Null after a solve that failed.
  std::vector<BoundedRows> problem_;
  std::vector<int> levels_;  // Level of the hierarchy, by level of problem_.
  std::vector<soth::VectorBound> bounds_;
  ActiveSides sides_;
  Eigen::VectorXd y_;
};

}  // namespace

std::unique_ptr<Peer> MakePeer(int num_variables,
                               const std::vector<LevelCapacity>& capacity) {
  return std::make_unique<SothPeer>(num_variables, capacity);
}

}  // namespace poise
