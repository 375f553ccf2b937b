// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/run_log.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "poise/sim/log/columns.h"
#include "poise/sim/log/csv_reader.h"
#include "poise/sim/log/open_log.h"
#include "poise/tools/commands/report/thinning.h"

namespace poise {
namespace {

using nlohmann::json;

// Numbers of rows in a page. A run of 10 s at 1 kHz keeps every tick in its
// plots, and two such runs take at most 5 MB. A run of 10 minutes replays at 30
// Hz.
constexpr long kFewestMotionRows = 3400;
constexpr long kMostMotionRows = 18000;
constexpr long kSignalRows = 10000;
constexpr long kTorqueRows = 5000;
constexpr long kTimingRows = 10000;

// Pauses shorter than the log divided by this number do not split a span.
constexpr long kSpansPerLog = 1000;

enum class Table { kMotion, kSignals, kTorques };

bool BelongsTo(Table table, ColumnGroup group) {
  using Group = ColumnGroup;
  switch (group) {
    case Group::kBasePose:
    case Group::kMoment:
    case Group::kPosition:
    case Group::kFootPosition:
    case Group::kPlan:
      return table == Table::kMotion;
    case Group::kBaseTilt:
    case Group::kCom:
    case Group::kContact:
    case Group::kForce:
      return table == Table::kMotion || table == Table::kSignals;
    case Group::kComReference:
    case Group::kCop:
    case Group::kPush:
    case Group::kTiltOrSlide:
    case Group::kResidual:
    case Group::kXi:
      return table == Table::kSignals;
    case Group::kTorque:
      return table == Table::kTorques;
    default:
      return false;
  }
}

bool BelongsTo(Table table, const std::string& column) {
  // The plots show only the height of the base's pose.
  const bool is_height =
      WithoutUnit(column) == WithoutUnit(BasePositionColumn('z'));
  return BelongsTo(table, GroupOf(column)) ||
         (table == Table::kSignals && is_height);
}

// The columns of the log that a table keeps, with fewer rows.
class LogTable {
 public:
  LogTable(Table table, const LogReader& log, ThinnedTable::Keep keep,
           long stride)
      : sources_(Sources(table, log)),
        errors_(Errors(table, log)),
        thinned_(Columns(log), keep, stride),
        row_(sources_.size() + errors_.size()) {}

  void Add(double time, const LogReader& log) {
    std::size_t i = 0;
    for (const int source : sources_) row_[i++] = log.Number(source);
    for (const Error& error : errors_) {
      row_[i++] = log.Number(error.actual) - log.Number(error.reference);
    }
    thinned_.Add(time, row_);
  }

  json Finish() { return thinned_.Finish(); }

 private:
  struct Error {
    std::string name;
    int actual;
    int reference;
  };

  static std::vector<int> Sources(Table table, const LogReader& log) {
    std::vector<int> sources;
    for (std::size_t i = 0; i < log.columns().size(); ++i) {
      if (BelongsTo(table, log.columns()[i])) {
        sources.push_back(static_cast<int>(i));
      }
    }
    return sources;
  }

  // Errors are computed before rows are dropped, because the extremes of a
  // difference are not the difference of the extremes.
  static std::vector<Error> Errors(Table table, const LogReader& log) {
    std::vector<Error> errors;
    if (table != Table::kSignals) return errors;
    for (const char axis : {'x', 'y', 'z'}) {
      const auto actual = log.Find(ComColumn(axis));
      const auto reference = log.Find(ComReferenceColumn(axis));
      if (actual && reference) {
        errors.push_back(
            {std::string("com_error.") + axis, *actual, *reference});
      }
    }
    return errors;
  }

  std::vector<ThinnedTable::Column> Columns(const LogReader& log) const {
    std::vector<ThinnedTable::Column> columns;
    for (const int source : sources_) {
      const std::string& column = log.columns()[source];
      columns.push_back(
          {std::string(WithoutUnit(column)), std::string(UnitOf(column))});
    }
    for (const Error& error : errors_) columns.push_back({error.name, "m"});
    return columns;
  }

  std::vector<int> sources_;
  std::vector<Error> errors_;
  ThinnedTable thinned_;
  std::vector<double> row_;
};

// Collects the intervals in which named states lasted.
class Spans {
 public:
  explicit Spans(long longest_pause) : longest_pause_(longest_pause) {}

  void Mark(long row, double time, double dt, std::string_view name,
            double value) {
    auto found = spans_.find(name);
    if (found == spans_.end()) {
      found = spans_.emplace(std::string(name), std::vector<Span>()).first;
    }
    std::vector<Span>& spans = found->second;
    if (spans.empty() || row - spans.back().last_row > longest_pause_) {
      spans.push_back({row, time, time, value});
    }
    Span& span = spans.back();
    span.last_row = row;
    span.to = time + dt;
    if (std::abs(value) > std::abs(span.value)) span.value = value;
  }

  // Returns the states, that with the longest total time first.
  json ActiveToJson() const {
    std::vector<std::pair<double, json>> rows;
    for (const auto& [name, spans] : spans_) {
      double total = 0, peak = 0;
      json list = json::array();
      for (const Span& span : spans) {
        total += span.to - span.from;
        peak = std::max(peak, std::abs(span.value));
        list.push_back({span.from, span.to, span.value});
      }
      rows.push_back(
          {total, {{"name", name}, {"peak", peak}, {"spans", list}}});
    }
    std::stable_sort(
        rows.begin(), rows.end(),
        [](const auto& a, const auto& b) { return a.first > b.first; });
    json active = json::array();
    for (auto& [total, row] : rows) active.push_back(std::move(row));
    return active;
  }

  json ToJson() const {
    json list = json::array();
    for (const auto& [name, spans] : spans_) {
      for (const Span& span : spans) {
        list.push_back({name, span.from, span.to});
      }
    }
    return list;
  }

 private:
  struct Span {
    long last_row;
    double from, to, value;
  };
  long longest_pause_;
  std::map<std::string, std::vector<Span>, std::less<>> spans_;
};

// Removes the first entry of a cell and returns it. Semicolons separate
// entries.
std::string_view TakeEntry(std::string_view* cell) {
  const std::string_view entry = cell->substr(0, cell->find(';'));
  cell->remove_prefix(std::min(cell->size(), entry.size() + 1));
  return entry;
}

// Marks the entries of a cell such as
// "left_foot.cop.x_max=41.2;torque.l_knee.max=3.0".
void MarkActive(std::string_view cell, long row, double time, double dt,
                Spans* active) {
  while (!cell.empty()) {
    const std::string_view entry = TakeEntry(&cell);
    const std::size_t equals = entry.rfind('=');
    if (equals == std::string_view::npos || equals == 0) continue;
    double value = 0;
    std::from_chars(entry.data() + equals + 1, entry.data() + entry.size(),
                    value);
    active->Mark(row, time, dt, entry.substr(0, equals), value);
  }
}

// Marks the entries of a cell such as "l_foot|r_foot;l_hand|l_thigh".
void MarkTouching(std::string_view cell, long row, double time, double dt,
                  Spans* touching) {
  while (!cell.empty()) {
    const std::string_view entry = TakeEntry(&cell);
    if (!entry.empty()) touching->Mark(row, time, dt, entry, 1);
  }
}

}  // namespace

json ReadRunLog(const std::filesystem::path& file,
                std::optional<long> num_rows) {
  const std::unique_ptr<LogReader> reader = OpenLog(file);
  LogReader& log = *reader;
  const std::string name = file.filename().string();
  const auto time_column = log.Find(kTimeColumn);
  if (!time_column) {
    throw std::invalid_argument(file.string() + ": has no column time");
  }
  const long expected = num_rows ? *num_rows : log.CountRows();
  const long motion_rows =
      std::clamp(expected / 33, kFewestMotionRows, kMostMotionRows);
  LogTable motion(Table::kMotion, log, ThinnedTable::Keep::kEvery,
                  StrideFor(expected, motion_rows));
  LogTable signals(Table::kSignals, log, ThinnedTable::Keep::kExtremes,
                   StrideFor(expected, kSignalRows));
  LogTable torques(Table::kTorques, log, ThinnedTable::Keep::kExtremes,
                   StrideFor(expected, kTorqueRows));
  const long pause = 1 + expected / kSpansPerLog;
  Spans active(pause), status(pause), touching(pause);

  const auto active_column = log.Find(kActiveColumn);
  const auto status_column = log.Find(kStatusColumn);
  const auto touching_column = log.Find(kTouchingColumn);
  json notes = json::array();
  long rows = 0;
  double previous = 0, dt = 0;
  while (log.Next()) {
    const double time = log.Number(*time_column);
    if (!std::isfinite(time) || (rows > 0 && time <= previous)) {
      notes.push_back("Row " + std::to_string(rows + 1) + " of " + name +
                      " must have a later time than the row before. The log "
                      "is shown up to this row.");
      break;
    }
    if (rows > 0) dt = time - previous;
    previous = time;
    motion.Add(time, log);
    signals.Add(time, log);
    torques.Add(time, log);
    if (active_column) {
      MarkActive(log.cell(*active_column), rows, time, dt, &active);
    }
    if (status_column && log.cell(*status_column) != "ok") {
      status.Mark(rows, time, dt, log.cell(*status_column), 1);
    }
    if (touching_column) {
      MarkTouching(log.cell(*touching_column), rows, time, dt, &touching);
    }
    ++rows;
  }
  if (log.cut_short()) {
    notes.push_back(name + " was cut short: its last row is incomplete.");
  } else if (rows == 0 && notes.empty()) {
    notes.push_back(name + " has a header and no rows.");
  }
  return {{"rows", rows},
          {"motion", motion.Finish()},
          {"signals", signals.Finish()},
          {"torques", torques.Finish()},
          {"active", active.ActiveToJson()},
          {"status", status.ToJson()},
          {"touching", touching.ToJson()},
          {"notes", std::move(notes)}};
}

json ReadTiming(const std::filesystem::path& timing_csv, double dt,
                std::optional<long> num_rows) {
  CsvReader timing(timing_csv);
  const auto tick = timing.Find("tick");
  const auto us = timing.Find("us");
  const auto iterations = timing.Find("iterations");
  ThinnedTable table(
      {{"us", "us"}, {"iterations", ""}}, ThinnedTable::Keep::kExtremes,
      StrideFor(num_rows ? *num_rows : timing.CountRows(), kTimingRows));
  while (tick && us && timing.Next()) {
    table.Add(timing.Number(*tick) * dt,
              {timing.Number(*us),
               iterations ? timing.Number(*iterations) : std::nan("")});
  }
  return table.Finish();
}

}  // namespace poise
