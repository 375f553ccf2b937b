// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace poise {

/// A table over time that thins itself while it is filled.
class ThinnedTable {
 public:
  struct Column {
    std::string name;
    std::string unit;
  };
  enum class Keep {
    kEvery,     ///< The first row of every `stride`.
    kExtremes,  ///< The least and greatest of every 2 `stride`, as they came.
  };

  ThinnedTable(std::vector<Column> columns, Keep keep, long stride);

  /// @param values one for each column.
  void Add(double time, const std::vector<double>& values);

  /// {rows, time, channels}; the table is complete.
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

/// The stride by which `rows` become at most `wanted`.
long StrideFor(long rows, long wanted);

}  // namespace poise
