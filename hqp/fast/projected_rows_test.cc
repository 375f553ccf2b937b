// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/fast/projected_rows.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>
#include <set>

#include "poise/hqp/fast/kernels.h"
#include "poise/tests/util/tolerance.h"

namespace poise {
namespace {

constexpr int kVariables = 7, kKeys = 9, kMaxRows = 6;

using Matrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows with an orthonormal basis that the test changes by itself. The second
// derivation is by products with this basis: l = Q r, remainder = r - Q' l.
class ProjectedRowsTest : public testing::Test {
 protected:
  ProjectedRowsTest() : projected_(kVariables, kKeys, kMaxRows) {
    std::normal_distribution<double> normal;
    Matrix square(kVariables, kVariables);
    for (double& entry : square.reshaped()) entry = normal(random_);
    q_ = Eigen::HouseholderQR<Matrix>(square).householderQ();
    rows_.resize(kKeys, kVariables);
    for (double& entry : rows_.reshaped()) entry = normal(random_);
    rows_.rowwise().normalize();
  }

  Eigen::VectorXd Coefficients(int key) const {
    return q_.topRows(rank_) * rows_.row(key).transpose();
  }
  Eigen::VectorXd Remainder(int key) const {
    return rows_.row(key).transpose() -
           q_.topRows(rank_).transpose() * Coefficients(key);
  }

  void Add(int key) {
    const Eigen::VectorXd l = Coefficients(key), rest = Remainder(key);
    const bool has_room = keys_.size() < kMaxRows;
    EXPECT_EQ(projected_.Add(key, l.data(), rest.data()), has_room);
    if (has_room) keys_.insert(key);
  }
  void Extend() { projected_.Extend(q_.row(rank_++).data(), kVariables); }
  void RemoveLast() {
    projected_.RemoveLast(q_.row(--rank_).data(), kVariables);
  }
  void Rotate(int e, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    kernels::Rotate(c, s, kVariables, q_.row(e).data(), q_.row(e + 1).data());
    projected_.Rotate(e, c, s);
  }

  void Swap(int e, int f) {
    q_.row(e).swap(q_.row(f));
    projected_.Swap(e, f);
  }
  void Negate(int e) {
    q_.row(e) *= -1;
    projected_.Negate(e);
  }

  // Each change adds a few eps to entries of at most 1.
  void ExpectSplits(int changes) {
    ASSERT_EQ(projected_.rank(), rank_);
    ASSERT_EQ(projected_.size(), static_cast<int>(keys_.size()));
    for (int key = 0; key < kKeys; ++key) {
      Eigen::VectorXd l(kVariables), rest(kVariables);
      ASSERT_EQ(projected_.Use(key, l.data(), rest.data()), keys_.count(key));
      if (keys_.count(key) == 0) continue;
      const double tolerance = Rounding(1, kVariables * (changes + 1));
      EXPECT_LE((l.head(rank_) - Coefficients(key)).norm(), tolerance);
      EXPECT_LE((rest - Remainder(key)).norm(), tolerance);
    }
  }

  std::mt19937 random_;
  Matrix q_, rows_;
  int rank_ = 0;
  std::set<int> keys_;
  ProjectedRows projected_;
};

TEST_F(ProjectedRowsTest, FollowsRandomChangesOfTheBasis) {
  for (int change = 0; change < 2000; ++change) {
    const int kind = static_cast<int>(random_() % 6);
    if (kind == 0 && rank_ < kVariables) Extend();
    if (kind == 1 && rank_ > 0) RemoveLast();
    if (kind == 2 && rank_ > 1) {
      Rotate(static_cast<int>(random_() % (rank_ - 1)), 0.1 * change);
    }
    if (kind == 4 && rank_ > 1) Swap(rank_ - 1, change % (rank_ - 1));
    if (kind == 5 && rank_ > 0) Negate(change % rank_);
    const int key = static_cast<int>(random_() % kKeys);
    if (kind == 3 && keys_.count(key) == 0) Add(key);
    ExpectSplits(change);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(keys_.size(), kMaxRows);
}

// A row of Q that is zero behind its first columns leaves the rest of a
// remainder alone.
TEST_F(ProjectedRowsTest, SubtractsFromTheFirstColumnsOnly) {
  for (const int key : {1, 2}) Add(key);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(kVariables);
  q.head(3) << 0.6, 0, -0.8;
  q.tail(kVariables - 3).setConstant(1000);  // Not read.
  projected_.Extend(q.data(), 3);
  projected_.RemoveLast(q.data(), 3);
  ExpectSplits(2);
}

TEST_F(ProjectedRowsTest, ChangesColumnsOfTheRemainders) {
  for (const int key : {5, 7}) Add(key);
  projected_.MoveColumn(6, 2);
  projected_.SetZero(4);
  rows_.col(2) = Eigen::VectorXd(rows_.col(6));
  rows_.col(4).setZero();
  ExpectSplits(0);
}

TEST_F(ProjectedRowsTest, KeepsOnlyUsedRows) {
  Extend();
  Extend();
  for (const int key : {4, 0, 8, 3}) Add(key);
  projected_.KeepUsed();  // Added rows count as used.
  ExpectSplits(2);
  projected_.KeepUsed();
  Eigen::VectorXd l(kVariables), rest(kVariables);
  for (const int key : {0, 3}) {
    EXPECT_TRUE(projected_.Use(key, l.data(), rest.data()));
  }
  for (const int key : {8, 1}) projected_.Keep(key);  // Row 1 is not there.
  projected_.KeepUsed();
  keys_ = {0, 3, 8};
  ExpectSplits(2);
}

TEST_F(ProjectedRowsTest, ClearRemovesAllRows) {
  for (const int key : {1, 2}) Add(key);
  rank_ = 3;
  projected_.Clear(rank_);
  keys_.clear();
  ExpectSplits(0);
  Add(1);
  Extend();
  ExpectSplits(1);
}

}  // namespace
}  // namespace poise
