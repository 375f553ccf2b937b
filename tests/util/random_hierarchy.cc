// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/random_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poise {
namespace {

// SplitMix64: unlike the standard's distributions, it gives the same numbers
// with every standard library.
class Source {
 public:
  explicit Source(std::uint64_t seed) : state_(seed) {}

  int Between(int low, int high) {  // Both ends included.
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

  HierarchyCase Draw();

 private:
  void DrawSelection(int i, EqualityBlock* block);

  void DrawEquality(int i, EqualityBlock* block);

  void DrawWeight(int chance, double* weight);

  void DrawInequality(int i, InequalityBlock* block);

  bool Meets() { return source_.Chance(integer_ ? 80 : options_.planted); }
  double Entry() {
    return integer_ ? source_.Between(-5, 5) : source_.Number();
  }
  double Wish() { return integer_ ? source_.Between(-4, 4) : source_.Number(); }
  double PowerOfTen(int low, int high) {
    return std::pow(10.0, source_.Between(low, high));
  }

  // Scale of a target or bound that does not pass through the common point. For
  // a nonzero row of integers the scale is an integer, too.
  double Scale(const Eigen::VectorXd& row) const {
    return std::max(row.cwiseAbs().maxCoeff(), 1e-3);
  }

  Eigen::VectorXd Row();
  Eigen::VectorXd SingleEntryRow();

  Source source_;
  RandomHierarchyOptions options_;
  bool scaled_ = false, degenerate_vertex_ = false, weighted_ = false,
       integer_ = false;
  Eigen::VectorXd planted_;
  Eigen::VectorXd columns_;  // Unit of each variable.
  std::vector<Eigen::VectorXd> rows_;
};

HierarchyCase Drawing::Draw() {
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
  degenerate_vertex_ = options_.degenerate_vertex > 0 &&
                       source_.Chance(options_.degenerate_vertex);
  weighted_ = options_.weighted > 0 && source_.Chance(options_.weighted);
  integer_ = options_.integer > 0 && source_.Chance(options_.integer);
  for (int j = 0; integer_ && j < n; ++j) {
    planted_[j] = source_.Chance(50) ? 0 : source_.Between(-3, 3);
  }
  columns_.setOnes(n);
  if (options_.columns > 0 && source_.Chance(options_.columns)) {
    for (double& unit : columns_) unit = PowerOfTen(-3, 6);
  }
  if (options_.small_columns > 0 && source_.Chance(options_.small_columns)) {
    for (double& unit : columns_) unit *= source_.Chance(50) ? 1e-3 : 1;
  }
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
    equalities.B *= columns_.asDiagonal();
    InequalityBlock inequalities =
        drawn.hierarchy.AddInequalities(level, capacity[level].inequalities);
    for (int i = 0; i < capacity[level].inequalities; ++i) {
      DrawInequality(i, &inequalities);
    }
    inequalities.C *= columns_.asDiagonal();
  }
  if (options_.bounds > 0) drawn.hierarchy.FindSpans();
  return drawn;
}

void Drawing::DrawSelection(int i, EqualityBlock* block) {
  const int j = source_.Between(0, static_cast<int>(planted_.size()) - 1);
  block->B(i, j) = source_.Chance(50) ? 1
                   : integer_         ? source_.Between(1, 3)
                                      : source_.Between(1, 300) / 100.0;
  block->b[i] = Wish();
  DrawWeight(30, &block->weight[i]);
}

void Drawing::DrawEquality(int i, EqualityBlock* block) {
  const Eigen::VectorXd row = Row();
  block->B.row(i) = row;
  block->b[i] = Meets() ? -row.dot(planted_) : Scale(row) * Wish();
  DrawWeight(20, &block->weight[i]);
}

void Drawing::DrawWeight(int chance, double* weight) {
  if (weighted_) {
    *weight = PowerOfTen(-options_.decades, options_.decades);
  } else if (source_.Chance(chance)) {
    *weight = source_.Between(0, 300) / 100.0;
  }
}

void Drawing::DrawInequality(int i, InequalityBlock* block) {
  const bool is_bound = options_.bounds > 0 && source_.Chance(options_.bounds);
  const Eigen::VectorXd row = is_bound ? SingleEntryRow() : Row();
  block->C.row(i) = row;
  double bound = Meets() ? row.dot(planted_) : Scale(row) * Wish();
  if (degenerate_vertex_) bound = 0;
  const int kind = source_.Between(0, 9);
  if (kind < 4) {
    block->upper[i] = bound;
  } else if (kind < 7) {
    block->lower[i] = bound;
  } else if (kind < 9) {
    block->lower[i] = bound;
    block->upper[i] =
        bound + (degenerate_vertex_ ? 0
                 : integer_         ? source_.Between(0, 4)
                            : Scale(row) * source_.Between(0, 300) / 100);
  } else {
    block->lower[i] = block->upper[i] = bound;
  }
}

Eigen::VectorXd Drawing::Row() {
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
      if (source_.Chance(density)) row[j] = Entry();
    }
    if (scaled_) row *= PowerOfTen(-3, 6);
  }
  rows_.push_back(row);
  return row;
}

Eigen::VectorXd Drawing::SingleEntryRow() {
  const int n = static_cast<int>(planted_.size());
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  row[source_.Between(0, n - 1)] = source_.Chance(50) ? 1 : -2;
  rows_.push_back(row);
  return row;
}

// The rows of one level, which can be changed.
struct LevelRows {
  RowMajorMatrix B, C;
  Eigen::VectorXd b, weight, lower, upper;
};

std::vector<LevelRows> Take(const Hierarchy& hierarchy) {
  std::vector<LevelRows> levels;
  for (int k = 0; k < hierarchy.num_levels(); ++k) {
    levels.push_back({hierarchy.B(k), hierarchy.C(k), hierarchy.b(k),
                      hierarchy.weight(k), hierarchy.lower(k),
                      hierarchy.upper(k)});
  }
  return levels;
}

void Put(const std::vector<LevelRows>& levels, Hierarchy* hierarchy) {
  hierarchy->Clear(static_cast<int>(levels.size()));
  for (size_t k = 0; k < levels.size(); ++k) {
    const LevelRows& from = levels[k];
    const auto level = static_cast<int>(k);
    EqualityBlock equalities =
        hierarchy->AddEqualities(level, static_cast<int>(from.B.rows()));
    equalities.B = from.B;
    equalities.b = from.b;
    equalities.weight = from.weight;
    InequalityBlock inequalities =
        hierarchy->AddInequalities(level, static_cast<int>(from.C.rows()));
    inequalities.C = from.C;
    inequalities.lower = from.lower;
    inequalities.upper = from.upper;
  }
  hierarchy->FindSpans();
}

// Changes one entry of a row, or makes the row a copy of another row, exactly
// or nearly.
void ChangeRow(Source* source, const std::vector<LevelRows>& levels,
               RowMajorMatrix* rows) {
  if (rows->rows() == 0) return;
  auto row = rows->row(source->Between(0, static_cast<int>(rows->rows()) - 1));
  const int kind = source->Between(0, 2);
  if (kind == 0) {
    row[source->Between(0, static_cast<int>(row.size()) - 1)] =
        source->Number();
    return;
  }
  const LevelRows& of =
      levels[source->Between(0, static_cast<int>(levels.size()) - 1)];
  const RowMajorMatrix& from = source->Chance(50) ? of.B : of.C;
  if (from.rows() == 0) return;
  const double rest = kind == 1 ? 0 : 0.1;
  row = rest * row +
        from.row(source->Between(0, static_cast<int>(from.rows()) - 1));
}

// Adds or removes a bound of an inequality, or makes both bounds equal.
void ChangeBounds(Source* source, LevelRows* level) {
  if (level->C.rows() == 0) return;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int i = source->Between(0, static_cast<int>(level->C.rows()) - 1);
  double &lower = level->lower[i], &upper = level->upper[i];
  const double bound = std::isinf(upper) ? lower : upper;
  if (std::isinf(bound)) return;
  lower = source->Chance(50) ? -kInfinity : bound;
  upper = source->Chance(50) ? kInfinity : bound;
}

void Change(Source* source, std::vector<LevelRows>* levels) {
  const int last = static_cast<int>(levels->size()) - 1;
  LevelRows& level = (*levels)[source->Between(0, last)];
  const auto rows = static_cast<int>(level.C.rows());
  switch (source->Between(0, 7)) {
    case 0:
      for (double& b : level.b) b += source->Number() / 10;
      break;
    case 1: {
      const double by = source->Number() / 10;
      level.lower.array() += by;
      level.upper.array() += by;
      break;
    }
    case 2:
      ChangeRow(source, *levels, &level.B);
      break;
    case 3:
      ChangeRow(source, *levels, &level.C);
      break;
    case 4:
      ChangeBounds(source, &level);
      break;
    case 5:
      for (double& lower : level.lower) lower = std::isinf(lower) ? lower : 0;
      for (double& upper : level.upper) upper = std::isinf(upper) ? upper : 0;
      break;
    case 6:
      std::swap(level, (*levels)[source->Between(0, last)]);
      if (last > 0 && source->Chance(20)) levels->pop_back();
      break;
    default:
      if (rows < 2) break;
      level.C.row(0).swap(level.C.row(rows - 1));
      std::swap(level.lower[0], level.lower[rows - 1]);
      std::swap(level.upper[0], level.upper[rows - 1]);
      level.C.conservativeResize(rows - 1, Eigen::NoChange);
      level.lower.conservativeResize(rows - 1);
      level.upper.conservativeResize(rows - 1);
  }
}

}  // namespace

HierarchyCase MakeRandomHierarchy(std::uint64_t seed,
                                  const RandomHierarchyOptions& options) {
  return Drawing(seed, options).Draw();
}

HierarchyCase WithRoomToChange(const HierarchyCase& drawn) {
  LevelCapacity most;
  for (const LevelCapacity& level : drawn.capacity) {
    most.equalities = std::max(most.equalities, level.equalities);
    most.inequalities = std::max(most.inequalities, level.inequalities);
  }
  const std::vector<LevelCapacity> capacity(drawn.capacity.size(), most);
  HierarchyCase result{capacity,
                       Hierarchy(drawn.hierarchy.num_variables(), capacity)};
  Put(Take(drawn.hierarchy), &result.hierarchy);
  return result;
}

void ChangeHierarchy(std::uint64_t seed, HierarchyCase* drawn) {
  Source source(seed);
  std::vector<LevelRows> levels = Take(drawn->hierarchy);
  for (int changes = source.Between(1, 3); changes > 0; --changes) {
    Change(&source, &levels);
  }
  Put(levels, &drawn->hierarchy);
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
