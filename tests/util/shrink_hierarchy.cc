// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/shrink_hierarchy.h"

#include <algorithm>
#include <cmath>

namespace poise {
namespace {

struct Row {
  int level;
  bool is_equality;
  std::vector<double> entries;
  double first, second;  // b and weight, or lower and upper.
};

// A hierarchy from which levels, rows and variables can be removed.
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
  using Ticks = std::vector<HierarchyCase>;

  Shrinking(const Ticks& failing,
            const std::function<bool(const Ticks&)>& fails);

  Ticks Run();

 private:
  static Ticks MakeAll(const std::vector<Draft>& drafts);

  // Replaces the drafts by smaller ones if these fail, too. Returns whether
  // they do.
  bool Try(const std::vector<Draft>& smaller);

  bool Try(size_t tick, const Draft& smaller);

  // Removes the earliest ticks first: the ticks shortly before a failure matter
  // most.
  void RemoveTicks();

  void RemoveWhatCanGo(size_t t);

  // Removes a row or variable from all ticks at once, because a solver
  // identifies rows by their position.
  void RemoveFromAll();

  template <typename Smaller>
  void TryAll(const Smaller& smaller) {
    std::vector<Draft> drafts;
    for (const Draft& draft : drafts_) drafts.push_back(smaller(draft));
    Try(drafts);
  }

  void SimplifyRow(size_t t, size_t i);

  // Replaces a number by zero or by the nearest integer, if the drafts still
  // fail.
  template <typename Pick>
  void Simplify(size_t t, const Pick& pick) {
    if (!Replace(t, pick, 0)) Replace(t, pick, std::round(*pick(&drafts_[t])));
  }

  template <typename Pick>
  bool Replace(size_t t, const Pick& pick, double number) {
    Draft smaller = drafts_[t];
    if (*pick(&smaller) == number) return true;
    *pick(&smaller) = number;
    return Try(t, smaller);
  }

  std::vector<Draft> drafts_;
  const std::function<bool(const Ticks&)>& fails_;
  bool has_shrunk_ = false;
};

Shrinking::Shrinking(const Ticks& failing,
                     const std::function<bool(const Ticks&)>& fails)
    : fails_(fails) {
  for (const HierarchyCase& tick : failing) {
    drafts_.push_back(Take(tick.hierarchy));
  }
}

Shrinking::Ticks Shrinking::Run() {
  do {
    has_shrunk_ = false;
    RemoveTicks();
    for (size_t t = 0; t < drafts_.size(); ++t) RemoveWhatCanGo(t);
    RemoveFromAll();
    for (size_t t = 0; t < drafts_.size(); ++t) {
      for (size_t i = 0; i < drafts_[t].rows.size(); ++i) SimplifyRow(t, i);
    }
  } while (has_shrunk_);
  return MakeAll(drafts_);
}

Shrinking::Ticks Shrinking::MakeAll(const std::vector<Draft>& drafts) {
  Ticks made;
  for (const Draft& draft : drafts) made.push_back(Make(draft));
  return made;
}

bool Shrinking::Try(const std::vector<Draft>& smaller) {
  if (!fails_(MakeAll(smaller))) return false;
  drafts_ = smaller;
  return has_shrunk_ = true;
}

bool Shrinking::Try(size_t tick, const Draft& smaller) {
  std::vector<Draft> drafts = drafts_;
  drafts[tick] = smaller;
  return Try(drafts);
}

void Shrinking::RemoveTicks() {
  for (size_t t = 0; t + 1 < drafts_.size();) {
    std::vector<Draft> fewer = drafts_;
    fewer.erase(fewer.begin() + t);
    if (!Try(fewer)) ++t;
  }
}

void Shrinking::RemoveWhatCanGo(size_t t) {
  for (int k = drafts_[t].num_levels - 1; k >= 0; --k) {
    if (drafts_[t].num_levels > 1) Try(t, WithoutLevel(drafts_[t], k));
  }
  for (size_t i = drafts_[t].rows.size(); i-- > 0;) {
    Try(t, WithoutRow(drafts_[t], i));
  }
}

void Shrinking::RemoveFromAll() {
  const bool has_others = drafts_.size() > 1;
  for (size_t i = has_others ? drafts_[0].rows.size() : 0; i-- > 0;) {
    const bool all =
        std::all_of(drafts_.begin(), drafts_.end(),
                    [i](const Draft& draft) { return i < draft.rows.size(); });
    if (all) TryAll([i](const Draft& draft) { return WithoutRow(draft, i); });
  }
  for (int j = drafts_[0].num_variables - 1; j >= 0; --j) {
    if (drafts_[0].num_variables == 1) return;
    TryAll([j](const Draft& draft) { return WithoutVariable(draft, j); });
  }
}

void Shrinking::SimplifyRow(size_t t, size_t i) {
  const Row row = drafts_[t].rows[i];
  for (size_t j = 0; j < row.entries.size(); ++j) {
    Simplify(t, [i, j](Draft* draft) { return &draft->rows[i].entries[j]; });
  }
  const auto first = [i](Draft* draft) { return &draft->rows[i].first; };
  const auto second = [i](Draft* draft) { return &draft->rows[i].second; };
  if (row.is_equality) {
    Simplify(t, first);
    Replace(t, second, 1);
  } else {
    if (!Replace(t, first, -INFINITY)) Simplify(t, first);
    if (!Replace(t, second, INFINITY)) Simplify(t, second);
  }
}

}  // namespace

HierarchyCase ShrinkHierarchy(
    const HierarchyCase& failing,
    const std::function<bool(const HierarchyCase&)>& fails) {
  return ShrinkTicks({failing},
                     [&](const std::vector<HierarchyCase>& one) {
                       return fails(one.front());
                     })
      .front();
}

std::vector<HierarchyCase> ShrinkTicks(
    const std::vector<HierarchyCase>& failing,
    const std::function<bool(const std::vector<HierarchyCase>&)>& fails) {
  return Shrinking(failing, fails).Run();
}

}  // namespace poise
