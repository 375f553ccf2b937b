// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The adapter of LexLSI, the lexicographic least-squares solver of LexLS.
#include <lexls/lexlsi.h>

#include "poise/tests/peers/bounded_rows.h"
#include "poise/tests/peers/peer.h"

namespace poise {
namespace {

// LexLSI subtracts bounds, so an absent bound is a large number. Its own
// examples use this one.
constexpr double kNoBound = 1e10;

// Its default of 200 is too few for some ticks of a strong push.
constexpr int kMostFactorizations = 1000;

class LexlsPeer final : public Peer {
 public:
  LexlsPeer(int num_variables, const std::vector<LevelCapacity>& capacity)
      : num_variables_(num_variables), sides_(NoActiveSides(capacity)) {}

  void Load(const Hierarchy& hierarchy) override {
    std::vector<BoundedRows> problem = ToBoundedRows(hierarchy, &levels_);
    if (!solver_ || !HaveSameSizes(problem, problem_)) Make(problem);
    problem_ = std::move(problem);
    data_.clear();
    for (const BoundedRows& level : problem_) {
      Eigen::MatrixXd data(level.rows(), num_variables_ + 2);
      data << level.A, level.lower.cwiseMax(-kNoBound),
          level.upper.cwiseMin(kNoBound);
      data_.push_back(std::move(data));
    }
  }

  bool Solve() override {
    solver_->reset();
    for (size_t k = 0; k < data_.size(); ++k) solver_->setData(k, data_[k]);
    Activate();
    const bool is_solved = solver_->solve() == LexLS::PROBLEM_SOLVED;
    y_ = solver_->get_x();
    ReadActive(is_solved);
    return is_solved;
  }

  void Forget() override { Deactivate(&sides_); }

  const Eigen::VectorXd& y() const override { return y_; }

 private:
  void Make(const std::vector<BoundedRows>& problem) {
    std::vector<LexLS::Index> rows;
    for (const BoundedRows& level : problem) rows.push_back(level.rows());
    std::vector<LexLS::ObjectiveType> types(rows.size(),
                                            LexLS::GENERAL_OBJECTIVE);
    solver_ = std::make_unique<LexLS::internal::LexLSI>(
        num_variables_, rows.size(), rows.data(), types.data());
    LexLS::ParametersLexLSI parameters;
    parameters.max_number_of_factorizations = kMostFactorizations;
    solver_->setParameters(parameters);
  }

  void Activate() {
    for (size_t k = 0; k < problem_.size(); ++k) {
      for (int i = 0; i < problem_[k].rows(); ++i) {
        const int source = problem_[k].source[i];
        if (source < 0) continue;
        const Side side = sides_[levels_[k]][source];
        if (side == Side::kNone) continue;
        solver_->api_activate(
            k, i,
            side == Side::kLower ? LexLS::CTR_ACTIVE_LB : LexLS::CTR_ACTIVE_UB);
      }
    }
  }

  // After a solve that failed, the next one starts without active rows.
  void ReadActive(bool is_solved) {
    Deactivate(&sides_);
    active_.clear();
    if (is_solved) solver_->getActiveCtr_order(active_);
    for (const LexLS::ConstraintIdentifier& row : active_) {
      const int source = problem_[row.obj_index].source[row.ctr_index];
      if (source < 0 || row.ctr_type == LexLS::CTR_ACTIVE_EQ) continue;
      sides_[levels_[row.obj_index]][source] =
          row.ctr_type == LexLS::CTR_ACTIVE_LB ? Side::kLower : Side::kUpper;
    }
  }

  int num_variables_;
  std::unique_ptr<LexLS::internal::LexLSI> solver_;
  std::vector<BoundedRows> problem_;
  std::vector<int> levels_;  // Level of the hierarchy, by level of problem_.
  std::vector<Eigen::MatrixXd> data_;  // [A, lower, upper].
  std::vector<LexLS::ConstraintIdentifier> active_;
  ActiveSides sides_;
  Eigen::VectorXd y_;
};

}  // namespace

std::unique_ptr<Peer> MakePeer(int num_variables,
                               const std::vector<LevelCapacity>& capacity) {
  return std::make_unique<LexlsPeer>(num_variables, capacity);
}

}  // namespace poise
