// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/thinning.h"

#include <cmath>
#include <limits>
#include <utility>

#include "poise/tools/commands/report/channel.h"

namespace poise {

ThinnedTable::ThinnedTable(std::vector<Column> columns, Keep keep, long stride)
    : columns_(std::move(columns)),
      keep_(stride == 1 ? Keep::kEvery : keep),
      stride_(stride),
      extremes_(columns_.size()),
      values_(columns_.size()) {}

void ThinnedTable::Add(double time, const std::vector<double>& values) {
  if (keep_ == Keep::kEvery) {
    if (in_bucket_ == 0) {
      time_.push_back(static_cast<float>(time));
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        values_[i].push_back(static_cast<float>(values[i]));
      }
    }
    in_bucket_ = (in_bucket_ + 1) % stride_;
    return;
  }
  if (in_bucket_ == 0) {
    bucket_start_ = time;
    for (Extremes& extremes : extremes_) extremes.empty = true;
  }
  if (in_bucket_ <= stride_) bucket_middle_ = time;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Extremes& extremes = extremes_[i];
    const double value = values[i];
    if (std::isnan(value)) continue;
    if (extremes.empty) {
      extremes = {value, value, true, false};
    } else if (value < extremes.least) {
      extremes.least = value;
      extremes.least_came_first = false;
    } else if (value > extremes.greatest) {
      extremes.greatest = value;
      extremes.least_came_first = true;
    }
  }
  if (++in_bucket_ == 2 * stride_) Emit();
}

void ThinnedTable::Emit() {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const bool one_row = in_bucket_ == 1;
  time_.push_back(static_cast<float>(bucket_start_));
  if (!one_row) time_.push_back(static_cast<float>(bucket_middle_));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Extremes& extremes = extremes_[i];
    float first = static_cast<float>(extremes.least);
    float second = static_cast<float>(extremes.greatest);
    if (!extremes.least_came_first) std::swap(first, second);
    if (extremes.empty) first = second = kNone;
    values_[i].push_back(first);
    if (!one_row) values_[i].push_back(second);
  }
  in_bucket_ = 0;
}

nlohmann::json ThinnedTable::Finish() {
  if (keep_ == Keep::kExtremes && in_bucket_ > 0) Emit();
  nlohmann::json channels = nlohmann::json::array();
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    channels.push_back(
        EncodeChannel(columns_[i].name, columns_[i].unit, values_[i]));
  }
  return {{"rows", time_.size()},
          {"time", EncodeFloats(time_)},
          {"channels", std::move(channels)}};
}

long StrideFor(long rows, long wanted) {
  return rows <= wanted ? 1 : (rows + wanted - 1) / wanted;
}

}  // namespace poise
