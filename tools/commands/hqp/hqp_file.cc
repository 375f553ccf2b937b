// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/hqp/hqp_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "poise/robot/finding.h"
#include "poise/sim/log/parse_json.h"

namespace poise {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The solver's memory grows with the square of this number, 0.3 GB for 2000.
constexpr int kMostVariables = 2000;
// The output grows with the square of the number of levels.
constexpr size_t kMostLevels = 1000;

[[noreturn]] void Refuse(const std::string& where, const std::string& what) {
  throw std::invalid_argument(where + ": " + what);
}

// Appends the keys that the format does not have, such as `lowr` instead of
// `lower`. Without this list, nobody would notice that they have no effect.
void ListOthers(const json& object, const std::string& where,
                const std::set<std::string>& known,
                std::vector<std::string>* others) {
  for (const auto& item : object.items()) {
    if (known.count(item.key()) == 0) others->push_back(where + item.key());
  }
}

// Returns the array `key` of an object, or an empty array if the key is absent.
const json& Array(const json& object, const char* key,
                  const std::string& where) {
  static const json kEmpty = json::array();
  const auto found = object.find(key);
  if (found == object.end()) return kEmpty;
  if (!found->is_array()) {
    Refuse(where + "." + key, "is " + ShowJson(*found) + ", must be an array");
  }
  return *found;
}

double Number(const json& value, const std::string& where) {
  if (!value.is_number()) {
    Refuse(where, "is " + ShowJson(value) + ", must be a number");
  }
  return value.get<double>();
}

// Returns a bound, or `absent` for null.
double Bound(const json& value, double absent, const std::string& where) {
  return value.is_null() ? absent : Number(value, where);
}

// Rejects rows with lower > upper, because the solvers reject them: see
// CheckInput().
void RefuseCrossed(const InequalityBlock& block, const std::string& lower,
                   const std::string& upper) {
  for (int i = 0; i < block.lower.size(); ++i) {
    if (block.lower[i] <= block.upper[i]) continue;
    const std::string row = "[" + std::to_string(i) + "]";
    Refuse(lower + row, "is " + PrintNumber(block.lower[i]) +
                            ", must not be above " + upper + row + ", " +
                            PrintNumber(block.upper[i]));
  }
}

void RefuseLength(const json& array, size_t wanted, const std::string& where) {
  if (array.size() == wanted) return;
  Refuse(where, "has " + Entries(array.size()) + ", must have " +
                    std::to_string(wanted));
}

// Returns the array `key` of a level, with one entry for each row of a matrix.
const json& Column(const json& level, const char* key, const char* matrix,
                   const std::string& where) {
  const json& rows = Array(level, matrix, where);
  const json& column = Array(level, key, where);
  if (!column.empty() && !level.contains(matrix)) {
    Refuse(where + "." + matrix, "is missing, but " + std::string(key) +
                                     " has " + Entries(column.size()));
  }
  if (!rows.empty() && !level.contains(key)) {
    Refuse(where + "." + key, "is missing, must have " + Entries(rows.size()) +
                                  ", as many as " + matrix + " has rows");
  }
  RefuseLength(column, rows.size(), where + "." + key);
  return column;
}

template <typename Matrix>
void ReadRow(const json& row, int i, const std::string& where, Matrix* to) {
  const std::string name = where + "[" + std::to_string(i) + "]";
  if (!row.is_array())
    Refuse(name, "is " + ShowJson(row) + ", must be an array");
  RefuseLength(row, to->cols(), name);
  for (int j = 0; j < to->cols(); ++j) {
    (*to)(i, j) = Number(row[j], name + "[" + std::to_string(j) + "]");
  }
}

void ReadEqualities(const json& level, int index, const std::string& where,
                    Hierarchy* hierarchy) {
  const json& B = Array(level, "B", where);
  const json& b = Column(level, "b", "B", where);
  const int rows = static_cast<int>(B.size());
  EqualityBlock block = hierarchy->AddEqualities(index, rows);
  for (int i = 0; i < rows; ++i) {
    ReadRow(B[i], i, where + ".B", &block.B);
    block.b[i] = Number(b[i], where + ".b[" + std::to_string(i) + "]");
  }
  if (!level.contains("weight")) return;
  const json& weight = Column(level, "weight", "B", where);
  for (int i = 0; i < rows; ++i) {
    const std::string name = where + ".weight[" + std::to_string(i) + "]";
    block.weight[i] = Number(weight[i], name);
    if (block.weight[i] < 0) {
      Refuse(name,
             "is " + PrintNumber(block.weight[i]) + ", must not be negative");
    }
  }
}

void ReadInequalities(const json& level, int index, const std::string& where,
                      Hierarchy* hierarchy) {
  const json& A = Array(level, "A", where);
  const json& a = Column(level, "a", "A", where);
  const int rows = static_cast<int>(A.size());
  InequalityBlock block = hierarchy->AddInequalities(index, rows);
  for (int i = 0; i < rows; ++i) {
    ReadRow(A[i], i, where + ".A", &block.C);
    block.upper[i] = -Number(a[i], where + ".a[" + std::to_string(i) + "]");
  }
  const json& C = Array(level, "C", where);
  const int sided_rows = static_cast<int>(C.size());
  InequalityBlock sided = hierarchy->AddInequalities(index, sided_rows);
  for (int i = 0; i < sided_rows; ++i) ReadRow(C[i], i, where + ".C", &sided.C);
  for (const char* key : {"lower", "upper"}) {
    if (!level.contains(key)) continue;
    const std::string name = where + "." + key;
    const json& bounds = Column(level, key, "C", where);
    const bool is_lower = key == std::string("lower");
    for (int i = 0; i < sided_rows; ++i) {
      (is_lower ? sided.lower : sided.upper)[i] =
          Bound(bounds[i], is_lower ? -kInfinity : kInfinity,
                name + "[" + std::to_string(i) + "]");
    }
  }
  RefuseCrossed(sided, where + ".lower", "upper");
}

void ReadBounds(const json& file, int level, Hierarchy* hierarchy) {
  const int n = hierarchy->num_variables();
  InequalityBlock block = hierarchy->AddInequalities(level, n);
  block.C.setIdentity();
  for (const char* key : {"y_lower", "y_upper"}) {
    if (!file.contains(key)) continue;
    const json& bounds = Array(file, key, "file");
    RefuseLength(bounds, n, key);
    const bool is_lower = key == std::string("y_lower");
    for (int j = 0; j < n; ++j) {
      (is_lower ? block.lower : block.upper)[j] =
          Bound(bounds[j], is_lower ? -kInfinity : kInfinity,
                std::string(key) + "[" + std::to_string(j) + "]");
    }
  }
  RefuseCrossed(block, "y_lower", "y_upper");
}

int Integer(const json& file, const char* key, int low, int high) {
  const auto found = file.find(key);
  if (found == file.end()) Refuse(key, "is missing");
  if (!found->is_number_integer() || *found < low || *found > high) {
    Refuse(key, "is " + ShowJson(*found) + ", must be a whole number from " +
                    std::to_string(low) + " to " + std::to_string(high));
  }
  return found->get<int>();
}

template <typename Vector>
ordered_json Head(const Vector& vector, int size) {
  ordered_json array = ordered_json::array();
  for (int i = 0; i < size; ++i) array.push_back(vector[i]);
  return array;
}

// Writes an infinite bound as null, because JSON has no infinity.
ordered_json Bounds(const Eigen::Map<const Eigen::VectorXd>& bounds) {
  ordered_json array = ordered_json::array();
  for (const double bound : bounds) {
    array.push_back(std::isinf(bound) ? ordered_json() : ordered_json(bound));
  }
  return array;
}

ordered_json Rows(const Eigen::Map<const RowMajorMatrix>& matrix) {
  ordered_json array = ordered_json::array();
  for (int i = 0; i < matrix.rows(); ++i) {
    array.push_back(Head(matrix.row(i), static_cast<int>(matrix.cols())));
  }
  return array;
}

}  // namespace

HqpProblem ReadHqp(const std::string& text, const std::string& source) {
  const json file = ParseJson(text, source);
  if (!file.is_object()) {
    throw std::invalid_argument(
        "is " + ShowJson(file) +
        ", must be an object with the keys format, variables and levels");
  }
  const auto format = file.find("format");
  if (format == file.end() || *format != "hqp-1") {
    Refuse("format",
           (format == file.end() ? "is missing" : "is " + ShowJson(*format)) +
               ", must be \"hqp-1\"");
  }
  const int n = Integer(file, "variables", 1, kMostVariables);
  const json& levels = Array(file, "levels", "file");
  if (!file.contains("levels")) {
    Refuse("levels", "is missing, must have 1 to " +
                         std::to_string(kMostLevels) + " entries");
  }
  if (levels.empty() || levels.size() > kMostLevels) {
    Refuse("levels", "has " + Entries(levels.size()) + ", must have 1 to " +
                         std::to_string(kMostLevels));
  }
  const bool has_bounds = file.contains("y_lower") || file.contains("y_upper");
  const int bounds_level = file.contains("y_bounds_level")
                               ? Integer(file, "y_bounds_level", 0,
                                         static_cast<int>(levels.size()) - 1)
                               : 0;

  std::vector<LevelCapacity> capacity;
  for (size_t level = 0; level < levels.size(); ++level) {
    const std::string where = "levels[" + std::to_string(level) + "]";
    if (!levels[level].is_object()) {
      Refuse(where, "is " + ShowJson(levels[level]) + ", must be an object");
    }
    const auto rows = [&](const char* key) {
      return static_cast<int>(Array(levels[level], key, where).size());
    };
    const bool bounds = has_bounds && bounds_level == static_cast<int>(level);
    capacity.push_back({rows("B"), rows("A") + rows("C") + (bounds ? n : 0)});
  }
  HqpProblem problem{capacity, Hierarchy(n, capacity), {}};
  ListOthers(file, "",
             {"format", "name", "variables", "levels", "y_lower", "y_upper",
              "y_bounds_level", "reference"},
             &problem.ignored);
  for (size_t level = 0; level < levels.size(); ++level) {
    const std::string where = "levels[" + std::to_string(level) + "]";
    const int index = static_cast<int>(level);
    ListOthers(levels[level], where + ".",
               {"name", "B", "b", "weight", "A", "a", "C", "lower", "upper",
                "equality_names", "inequality_names"},
               &problem.ignored);
    ReadEqualities(levels[level], index, where, &problem.hierarchy);
    ReadInequalities(levels[level], index, where, &problem.hierarchy);
  }
  if (has_bounds) ReadBounds(file, bounds_level, &problem.hierarchy);
  problem.hierarchy.FindSpans();
  return problem;
}

std::string WriteHqp(const Hierarchy& hierarchy) {
  ordered_json file;
  file["format"] = "hqp-1";
  file["variables"] = hierarchy.num_variables();
  file["levels"] = ordered_json::array();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const int equalities = hierarchy.num_equalities(level);
    ordered_json to = ordered_json::object();
    to["B"] = Rows(hierarchy.B(level));
    to["b"] = Head(hierarchy.b(level), equalities);
    to["weight"] = Head(hierarchy.weight(level), equalities);
    to["C"] = Rows(hierarchy.C(level));
    to["lower"] = Bounds(hierarchy.lower(level));
    to["upper"] = Bounds(hierarchy.upper(level));
    file["levels"].push_back(to);
  }
  return file.dump();
}

std::string Name(Status status) {
  switch (status) {
    case Status::kOptimal:
      return "optimal";
    case Status::kIterationLimit:
      return "iteration_limit";
    case Status::kNotFinite:
      return "not_finite";
    case Status::kBadInput:
      return "bad_input";
  }
  return "";
}

int CertifiedLevels(const Hierarchy& hierarchy, const Solution& solution) {
  switch (solution.status) {
    case Status::kOptimal:
      return hierarchy.num_levels();
    case Status::kIterationLimit:  // num_levels() if y's norm failed.
      return std::min(solution.failed_level, hierarchy.num_levels());
    case Status::kNotFinite:
    case Status::kBadInput:
      return 0;
  }
  return 0;
}

std::string DescribeHqpSolution(const Hierarchy& hierarchy,
                                const Solution& solution,
                                const Certificate& certificate,
                                const SolveTimes& times) {
  const int levels = hierarchy.num_levels();
  const int certified = CertifiedLevels(hierarchy, solution);
  std::ostringstream text;
  text << Name(solution.status) << ", " << solution.iterations
       << " iterations, " << times.measured << " us, ";
  if (times.modelled) text << *times.modelled << " us predicted, ";
  if (certified == 0) {
    text << "no certificate";
  } else {
    text << "certificate " << certificate.worst();
    if (certified < levels) {
      text << " of the first " << certified << " of " << levels << " levels";
    }
  }
  text << "\n";
  for (int level = 0; level < levels; ++level) {
    text << "  level " << level << ": cost " << solution.levels[level].cost
         << ", gap " << solution.levels[level].gap << ", nullity "
         << solution.levels[level].nullity
         << (level < certified ? "" : ", NOT certified") << "\n";
  }
  return text.str();
}

std::string WriteHqpSolution(const Hierarchy& hierarchy,
                             const Solution& solution,
                             const Certificate& certificate,
                             const SolveTimes& times) {
  ordered_json out;
  out["status"] = Name(solution.status);
  out["y"] = Head(solution.y, hierarchy.num_variables());
  out["levels"] = ordered_json::array();
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    const LevelSolution& from = solution.levels[level];
    const int inequalities = hierarchy.num_inequalities(level);
    ordered_json to;
    to["cost"] = from.cost;
    to["gap"] = std::isfinite(from.gap) ? json(from.gap) : json(nullptr);
    to["equality_residual"] =
        Head(from.equality_residual, hierarchy.num_equalities(level));
    to["slack"] = Head(from.slack, inequalities);
    to["active"] = ordered_json::array();
    for (int i = 0; i < inequalities; ++i) {
      to["active"].push_back(static_cast<int>(from.active[i]));
    }
    to["nullity"] = from.nullity;
    to["multipliers"] = ordered_json::array();
    for (int above = 0; above < level; ++above) {
      const LevelMultipliers& multipliers = from.multipliers[above];
      ordered_json entry;
      entry["level"] = above;
      entry["equality"] =
          Head(multipliers.equality, hierarchy.num_equalities(above));
      entry["inequality"] =
          Head(multipliers.inequality, hierarchy.num_inequalities(above));
      to["multipliers"].push_back(entry);
    }
    out["levels"].push_back(to);
  }
  out["failed_level"] = solution.failed_level < 0
                            ? ordered_json()
                            : ordered_json(solution.failed_level);
  const int certified = CertifiedLevels(hierarchy, solution);
  out["certified_levels"] = certified;
  // Zeros would look like a perfect certificate, so write null if there is
  // none.
  const auto number = [&](double value) {
    return certified > 0 ? ordered_json(value) : ordered_json();
  };
  out["certificate"] = {
      {"stationarity", number(certificate.stationarity)},
      {"feasibility", number(certificate.feasibility)},
      {"complementarity", number(certificate.complementarity)},
      {"priority", number(certificate.priority)}};
  out["iterations"] = solution.iterations;
  out["microseconds"] = times.measured;
  out["modelled_us"] =
      times.modelled ? ordered_json(*times.modelled) : ordered_json();
  return out.dump();
}

}  // namespace poise
