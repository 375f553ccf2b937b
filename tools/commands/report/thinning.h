// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace poise {

/// A table over time that keeps only part of the rows that are added.
class ThinnedTable {
 public:
  struct Column {
    std::string name;
    std::string unit;
  };
  enum class Keep {
    kEvery,     ///< Keeps the first of every `stride` rows.
    kExtremes,  ///< Keeps minimum and maximum of 2 `stride` rows in order.
  };

  ThinnedTable(std::vector<Column> columns, Keep keep, long stride);

  /// Adds a row. @param values  one value for each column.
  void Add(double time, const std::vector<double>& values);

  /// Returns {rows, time, channels}. No row may be added afterwards.
  nlohmann::json Finish();

 private:
  struct Extremes {
    double least, greatest;
    bool least_came_first;
    bool empty = true;
  };

  void Emit();

  std::vector<Column> columns_;
  Keep keep_;
  long stride_;
  long in_bucket_ = 0;
  double bucket_start_ = 0;
  double bucket_middle_ = 0;
  std::vector<Extremes> extremes_;
  std::vector<float> time_;
  std::vector<std::vector<float>> values_;
};

/// Returns the smallest stride with which `rows` rows become at most `wanted`.
long StrideFor(long rows, long wanted);

}  // namespace poise
