// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/exact/small_hierarchy.h"

#include <Eigen/Core>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  HierarchyCase Make() {
    is_whole_ = Chance(50);
    const int n = Between(2, 6), levels = Between(1, 4);
    std::vector<LevelCapacity> capacity(levels);
    for (LevelCapacity& level : capacity) {
      const int rows = Between(0, 4);
      level.equalities = Between(0, rows);
      level.inequalities = rows - level.equalities;
    }
    HierarchyCase drawn{capacity, Hierarchy(n, capacity)};
    drawn.hierarchy.Clear(levels);
    for (int k = 0; k < levels; ++k) {
      EqualityBlock equalities =
          drawn.hierarchy.AddEqualities(k, capacity[k].equalities);
      for (int i = 0; i < capacity[k].equalities; ++i) {
        const Row row = MakeRow(n);
        equalities.B.row(i) = row.entries;
        equalities.b[i] = -row.target;
        equalities.weight[i] = Chance(60) ? 1 : Between(0, 4);
      }
      InequalityBlock inequalities =
          drawn.hierarchy.AddInequalities(k, capacity[k].inequalities);
      for (int i = 0; i < capacity[k].inequalities; ++i) {
        const Row row = MakeRow(n);
        inequalities.C.row(i) = row.entries;
        std::tie(inequalities.lower[i], inequalities.upper[i]) =
            MakeBounds(row.target);
      }
    }
    return drawn;
  }

 private:
  struct Row {
    Eigen::RowVectorXd entries;
    double target;  // Or one of the bounds.
  };

  // The distributions of the standard library differ between platforms.
  int Between(int low, int high) {
    return low + static_cast<int>(random_() % (high - low + 1));
  }
  bool Chance(int percent) { return Between(1, 100) <= percent; }
  double Number() {
    return is_whole_ ? Between(-3, 3) : Between(-192, 192) / 64.;
  }

  Row MakeRow(int n) {
    Row row{Eigen::RowVectorXd::Zero(n), Number()};
    if (!Chance(33)) {
      for (double& entry : row.entries) entry = Chance(30) ? 0 : Number();
    } else if (!rows_.empty() && Chance(90)) {
      const Row& earlier =
          rows_[Between(0, static_cast<int>(rows_.size()) - 1)];
      const int factor = Chance(50) ? 1 : Between(-2, 2);
      row.entries = factor * earlier.entries;
      if (Chance(50)) row.target = factor * earlier.target;
    }
    rows_.push_back(row);
    return row;
  }

  std::pair<double, double> MakeBounds(double bound) {
    switch (Between(0, 5)) {
      case 0:
        return {bound, bound};
      case 1:
        return {bound, bound + Between(0, 3)};
      case 2:
      case 3:
        return {bound, kInfinity};
      default:
        return {-kInfinity, bound};
    }
  }

  std::mt19937_64 random_;
  bool is_whole_ = false;
  std::vector<Row> rows_;
};

}  // namespace

HierarchyCase MakeSmallHierarchy(std::uint64_t seed) {
  return Draw(seed).Make();
}

}  // namespace poise
