// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "poise/python/python_solution.h"
#include "poise/tools/commands/hqp/hqp_file.h"

namespace poise {
namespace {

// A multiplier or a violation below this part of the largest one is rounding.
constexpr double kNegligible = 1e-9;

std::string LevelName(const PythonHierarchy& source, int level) {
  const std::string& name = source.levels[level]->name;
  return "level " + std::to_string(level) +
         (name.empty() ? "" : " '" + name + "'");
}

// Returns the bound at which a row is: "at its upper bound 1".
std::string BoundText(const PythonLevel& level, int row, Side side) {
  std::ostringstream text;
  if (side == Side::kUpper) {
    text << "at its upper bound " << level.upper[row];
  } else if (side == Side::kLower) {
    text << "at its lower bound " << level.lower[row];
  } else {
    text << "inactive";
  }
  return text.str();
}

// Writes the rows of a level that are violated by its own optimum.
void WriteViolated(const PythonSolution& solved, int level,
                   std::ostringstream* text) {
  const LevelSolution& found = solved.solution.levels[level];
  const int equalities = solved.num_equalities(level);
  const int inequalities = solved.num_inequalities(level);
  const double size = 1 + solved.solution.y.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < equalities; ++i) {
    const double residual = found.equality_residual[i];
    if (!(std::abs(residual) > kNegligible * size)) continue;
    *text << "  " << NameRow(solved.source, level, i, true)
          << " has the residual " << residual << "\n";
  }
  for (int i = 0; i < inequalities; ++i) {
    if (!(found.slack[i] > kNegligible * size)) continue;
    *text << "  " << NameRow(solved.source, level, i, false)
          << " is violated by " << found.slack[i] << "\n";
  }
}

// Writes the rows of the levels above that have a multiplier of this level.
void WriteBinding(const PythonSolution& solved, int level,
                  std::ostringstream* text) {
  const auto& multipliers = solved.solution.levels[level].multipliers;
  double largest = 0;
  for (int j = 0; j < level; ++j) {
    for (int i = 0; i < solved.num_equalities(j); ++i) {
      largest = std::max(largest, std::abs(multipliers[j].equality[i]));
    }
    for (int i = 0; i < solved.num_inequalities(j); ++i) {
      largest = std::max(largest, std::abs(multipliers[j].inequality[i]));
    }
  }
  const auto write = [&](int j, int i, bool is_equality, double multiplier) {
    if (!(std::abs(multiplier) > kNegligible * largest)) return;
    *text << "  binding: " << NameRow(solved.source, j, i, is_equality);
    if (!is_equality) {
      *text << ", "
            << BoundText(*solved.source.levels[j], i,
                         solved.solution.levels[j].active[i]);
    }
    *text << ": multiplier " << multiplier << "\n";
  };
  for (int j = 0; j < level; ++j) {
    for (int i = 0; i < solved.num_equalities(j); ++i) {
      write(j, i, true, multipliers[j].equality[i]);
    }
    for (int i = 0; i < solved.num_inequalities(j); ++i) {
      write(j, i, false, multipliers[j].inequality[i]);
    }
  }
}

}  // namespace

std::string NameRow(const PythonHierarchy& source, int level, int row,
                    bool is_equality) {
  const PythonLevel& of = *source.levels[level];
  const std::string& name =
      is_equality ? of.equality_names[row] : of.inequality_names[row];
  return LevelName(source, level) + ", row " + std::to_string(row) +
         (is_equality ? " of B" : " of C") +
         (name.empty() ? "" : " '" + name + "'");
}

std::string ExplainSolution(const PythonSolution& solved) {
  std::ostringstream text;
  const Hierarchy hierarchy = MakeHierarchy(solved.source);
  text << DescribeHqpSolution(hierarchy, solved.solution,
                              solved.solution.certificate,
                              {solved.microseconds, {}});
  const int certified = CertifiedLevels(hierarchy, solved.solution);
  for (int level = 0; level < certified; ++level) {
    std::ostringstream rows;
    WriteViolated(solved, level, &rows);
    WriteBinding(solved, level, &rows);
    text << LevelName(solved.source, level)
         << (rows.str().empty() ? ": all rows are met, no binding row above\n"
                                : ":\n")
         << rows.str();
  }
  return text.str();
}

}  // namespace poise
