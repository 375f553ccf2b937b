// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tests/util/random_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

// SplitMix64: the standard's distributions differ between libraries.
class Source {
 public:
  explicit Source(std::uint64_t seed) : state_(seed) {}

  int Between(int low, int high) {  // Both included.
    return low + static_cast<int>(Next() % (high - low + 1));
  }
  bool Chance(int percent) { return Between(0, 99) < percent; }
  double Number() { return Between(-300, 300) / 100.0; }

 private:
  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

class Drawing {
 public:
  Drawing(std::uint64_t seed, const RandomHierarchyOptions& options)
      : source_(seed), options_(options) {}

  HierarchyCase Draw() {
    const int n = source_.Between(1, options_.max_variables);
    const int levels = source_.Between(1, options_.max_levels);
    std::vector<LevelCapacity> capacity;
    const bool selecting = source_.Chance(options_.selecting);
    const int first_selecting =
        selecting ? source_.Between(0, levels - 1) : levels;
    for (int level = 0; level < levels; ++level) {
      const bool selects = level >= first_selecting;
      capacity.push_back(
          {source_.Between(0, selects ? n : options_.max_equalities),
           selects ? 0 : source_.Between(0, options_.max_inequalities)});
    }
    HierarchyCase drawn{capacity, Hierarchy(n, capacity)};
    scaled_ = source_.Chance(options_.scaled);
    planted_.resize(n);
    for (int j = 0; j < n; ++j) planted_[j] = source_.Number();
    for (int level = 0; level < levels; ++level) {
      EqualityBlock equalities =
          drawn.hierarchy.AddEqualities(level, capacity[level].equalities);
      for (int i = 0; i < capacity[level].equalities; ++i) {
        if (level >= first_selecting) {
          DrawSelection(i, &equalities);
        } else {
          DrawEquality(i, &equalities);
        }
      }
      InequalityBlock inequalities =
          drawn.hierarchy.AddInequalities(level, capacity[level].inequalities);
      for (int i = 0; i < capacity[level].inequalities; ++i) {
        DrawInequality(i, &inequalities);
      }
    }
    return drawn;
  }

 private:
  void DrawSelection(int i, EqualityBlock* block) {
    const int j = source_.Between(0, static_cast<int>(planted_.size()) - 1);
    block->B(i, j) = source_.Chance(50) ? 1 : source_.Between(1, 300) / 100.0;
    block->b[i] = source_.Number();
    if (source_.Chance(30)) block->weight[i] = source_.Between(0, 300) / 100.0;
  }

  void DrawEquality(int i, EqualityBlock* block) {
    const Eigen::VectorXd row = Row();
    block->B.row(i) = row;
    block->b[i] = source_.Chance(options_.planted)
                      ? -row.dot(planted_)
                      : Scale(row) * source_.Number();
    if (source_.Chance(20)) block->weight[i] = source_.Between(0, 300) / 100.0;
  }

  void DrawInequality(int i, InequalityBlock* block) {
    const Eigen::VectorXd row = Row();
    block->C.row(i) = row;
    const double bound = source_.Chance(options_.planted)
                             ? row.dot(planted_)
                             : Scale(row) * source_.Number();
    const int kind = source_.Between(0, 9);
    if (kind < 4) {
      block->upper[i] = bound;
    } else if (kind < 7) {
      block->lower[i] = bound;
    } else if (kind < 9) {
      block->lower[i] = bound;
      block->upper[i] = bound + Scale(row) * source_.Between(0, 300) / 100;
    } else {
      block->lower[i] = block->upper[i] = bound;
    }
  }

  double Scale(const Eigen::VectorXd& row) const {
    return std::max(row.cwiseAbs().maxCoeff(), 1e-3);
  }

  Eigen::VectorXd Row() {
    const int n = static_cast<int>(planted_.size());
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    const int drawn = static_cast<int>(rows_.size());
    if (source_.Chance(options_.degenerate)) {
      switch (source_.Between(0, 4)) {
        case 0:
          break;  // Zeros.
        case 1:
          if (drawn > 0) row = rows_[source_.Between(0, drawn - 1)];
          break;
        case 2:
          if (drawn > 0) row = -2 * rows_[source_.Between(0, drawn - 1)];
          break;
        case 3:
          for (int k = 0; k < 2 && drawn > 0; ++k) {
            row += rows_[source_.Between(0, drawn - 1)];
          }
          break;
        default:
          row[source_.Between(0, n - 1)] = 1;
      }
    } else {
      const int density = source_.Chance(50) ? 100 : 40;
      for (int j = 0; j < n; ++j) {
        if (source_.Chance(density)) row[j] = source_.Number();
      }
      if (scaled_) row *= std::pow(10.0, source_.Between(-3, 6));
    }
    rows_.push_back(row);
    return row;
  }

  Source source_;
  RandomHierarchyOptions options_;
  bool scaled_ = false;
  Eigen::VectorXd planted_;
  std::vector<Eigen::VectorXd> rows_;
};

}  // namespace

HierarchyCase MakeRandomHierarchy(std::uint64_t seed,
                                  const RandomHierarchyOptions& options) {
  return Drawing(seed, options).Draw();
}

double CostSize(const Hierarchy& hierarchy, int level,
                const Solution& solution) {
  const double norm = solution.y.norm();
  double size = 0;
  for (int i = 0; i < hierarchy.num_equalities(level); ++i) {
    size += hierarchy.weight(level)[i] *
            std::pow(hierarchy.B(level).row(i).norm() * norm +
                         std::abs(hierarchy.b(level)[i]),
                     2);
  }
  for (int i = 0; i < hierarchy.num_inequalities(level); ++i) {
    size += std::pow(hierarchy.C(level).row(i).norm() * norm +
                         solution.levels[level].slack[i],
                     2);
  }
  return size;
}

}  // namespace poise
