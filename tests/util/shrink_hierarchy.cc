// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "tests/util/shrink_hierarchy.h"

#include <cmath>

namespace poise {
namespace {

struct Row {
  int level;
  bool is_equality;
  std::vector<double> entries;
  double first, second;  // b and weight, or lower and upper.
};

// A hierarchy in pieces that can be taken away.
struct Draft {
  int num_variables, num_levels;
  std::vector<Row> rows;
};

Draft Take(const Hierarchy& hierarchy) {
  Draft draft{hierarchy.num_variables(), hierarchy.num_levels(), {}};
  const auto add = [&](int level, bool is_equality, const auto& row,
                       double first, double second) {
    std::vector<double> entries;
    for (int j = 0; j < draft.num_variables; ++j) entries.push_back(row[j]);
    draft.rows.push_back({level, is_equality, entries, first, second});
  };
  for (int k = 0; k < draft.num_levels; ++k) {
    for (int i = 0; i < hierarchy.num_equalities(k); ++i) {
      add(k, true, hierarchy.B(k).row(i), hierarchy.b(k)[i],
          hierarchy.weight(k)[i]);
    }
    for (int i = 0; i < hierarchy.num_inequalities(k); ++i) {
      add(k, false, hierarchy.C(k).row(i), hierarchy.lower(k)[i],
          hierarchy.upper(k)[i]);
    }
  }
  return draft;
}

HierarchyCase Make(const Draft& draft) {
  std::vector<LevelCapacity> capacity(draft.num_levels);
  for (const Row& row : draft.rows) {
    LevelCapacity& of = capacity[row.level];
    ++(row.is_equality ? of.equalities : of.inequalities);
  }
  HierarchyCase made{capacity, Hierarchy(draft.num_variables, capacity)};
  for (const Row& row : draft.rows) {
    const Eigen::Map<const Eigen::RowVectorXd> entries(row.entries.data(),
                                                       draft.num_variables);
    if (row.is_equality) {
      EqualityBlock block = made.hierarchy.AddEqualities(row.level, 1);
      block.B = entries;
      block.b[0] = row.first;
      block.weight[0] = row.second;
    } else {
      InequalityBlock block = made.hierarchy.AddInequalities(row.level, 1);
      block.C = entries;
      block.lower[0] = row.first;
      block.upper[0] = row.second;
    }
  }
  return made;
}

Draft WithoutLevel(Draft draft, int level) {
  std::vector<Row> rows;
  for (Row& row : draft.rows) {
    if (row.level == level) continue;
    if (row.level > level) --row.level;
    rows.push_back(row);
  }
  --draft.num_levels;
  draft.rows = rows;
  return draft;
}

Draft WithoutRow(Draft draft, size_t row) {
  draft.rows.erase(draft.rows.begin() + row);
  return draft;
}

Draft WithoutVariable(Draft draft, int variable) {
  for (Row& row : draft.rows) {
    row.entries.erase(row.entries.begin() + variable);
  }
  --draft.num_variables;
  return draft;
}

class Shrinking {
 public:
  Shrinking(const HierarchyCase& failing,
            const std::function<bool(const HierarchyCase&)>& fails)
      : draft_(Take(failing.hierarchy)), fails_(fails) {}

  HierarchyCase Run() {
    do {
      has_shrunk_ = false;
      RemoveWhatCanGo();
      for (size_t i = 0; i < draft_.rows.size(); ++i) SimplifyRow(i);
    } while (has_shrunk_);
    return Make(draft_);
  }

 private:
  // True, and it is the draft from now on, if it fails, too.
  bool Try(const Draft& smaller) {
    if (!fails_(Make(smaller))) return false;
    draft_ = smaller;
    return has_shrunk_ = true;
  }

  void RemoveWhatCanGo() {
    for (int k = draft_.num_levels - 1; k >= 0 && draft_.num_levels > 1; --k) {
      Try(WithoutLevel(draft_, k));
    }
    for (size_t i = draft_.rows.size(); i-- > 0;) Try(WithoutRow(draft_, i));
    for (int j = draft_.num_variables - 1; j >= 0 && draft_.num_variables > 1;
         --j) {
      Try(WithoutVariable(draft_, j));
    }
  }

  void SimplifyRow(size_t i) {
    const Row& row = draft_.rows[i];
    for (size_t j = 0; j < row.entries.size(); ++j) {
      Simplify([i, j](Draft* draft) { return &draft->rows[i].entries[j]; });
    }
    const auto first = [i](Draft* draft) { return &draft->rows[i].first; };
    const auto second = [i](Draft* draft) { return &draft->rows[i].second; };
    if (row.is_equality) {
      Simplify(first);
      Replace(second, 1);
    } else {
      if (!Replace(first, -INFINITY)) Simplify(first);
      if (!Replace(second, INFINITY)) Simplify(second);
    }
  }

  // To zero, or a whole number.
  template <typename Pick>
  void Simplify(const Pick& pick) {
    if (!Replace(pick, 0)) Replace(pick, std::round(*pick(&draft_)));
  }

  template <typename Pick>
  bool Replace(const Pick& pick, double number) {
    Draft smaller = draft_;
    if (*pick(&smaller) == number) return true;
    *pick(&smaller) = number;
    return Try(smaller);
  }

  Draft draft_;
  const std::function<bool(const HierarchyCase&)>& fails_;
  bool has_shrunk_ = false;
};

}  // namespace

HierarchyCase ShrinkHierarchy(
    const HierarchyCase& failing,
    const std::function<bool(const HierarchyCase&)>& fails) {
  return Shrinking(failing, fails).Run();
}

}  // namespace poise
