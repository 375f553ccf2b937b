// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/recorder.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <system_error>
#include <vector>

#include "poise/robot/control/conflict.h"
#include "poise/robot/output_file.h"
#include "poise/sim/log/columns.h"

namespace poise {

namespace {

constexpr int kRowsAtOnce = 50;
// Smallest slack of a row that counts as violated. Rows are scaled so that 1 is
// a typical value.
constexpr double kNoticeableSlack = 1e-6;
// Shortest time between two searches for a conflict, s. A conflict lasts for
// many ticks, and a search costs about ten solutions of the hierarchy.
constexpr double kBetweenConflicts = 0.05;

// Returns the last priority level that a task has.
int LastLevel(const Stack& stack) {
  int last = 0;
  for (int i = 0; i < stack.num_tasks(); ++i) {
    last = std::max(last, stack.settings(i).level);
  }
  return last;
}

std::vector<LogColumn> Columns(const Robot& robot, const Stack& stack) {
  std::vector<std::string> feet, joints, tasks;
  for (const Foot& foot : robot.feet) feet.push_back(foot.name);
  for (const Joint& joint : robot.model.tree.joints()) {
    joints.push_back(joint.name);
  }
  for (int i = 0; i < stack.num_tasks(); ++i) {
    tasks.emplace_back(stack.task(i).name());
  }
  return LogColumns(feet, joints, tasks, LastLevel(stack));
}

// Returns the cell that says why a tick is not ok; empty if it is.
std::string Reason(const TickRecord& record) {
  const TickReport& report = record.report;
  if (report.status == TickStatus::kTruncated) {
    return "rank_" + std::to_string(report.failed_level);
  }
  if (report.relaxed) return LogName(record.stack.RowName(*report.relaxed));
  return std::string(ReasonName(report.fail_safe_reason));
}

// Returns the highest level with a row that is not met; -1 if all rows are met.
int LevelNotMet(const TickRecord& record) {
  int not_met = Stack::kMaxLevel + 1;
  for (const LostRow& lost : record.report.lost) {
    not_met = std::min(not_met, record.report.tasks[lost.task].level);
  }
  for (const ActiveRow& active : record.report.active) {
    if (active.slack < kNoticeableSlack) continue;
    not_met = std::min(not_met, record.report.tasks[active.task].level);
  }
  for (int level = 0; level < record.hierarchy.num_levels(); ++level) {
    if (record.stack.priority_level(level) == not_met) return level;
  }
  return -1;
}

// Names each body after the first link that is fixed to it.
std::vector<std::string> BodyNames(const Tree& tree) {
  std::vector<std::string> names(tree.num_bodies());
  for (const Frame& frame : tree.frames()) {
    if (names[frame.body].empty()) names[frame.body] = frame.name;
  }
  for (std::string& name : names) name = LogName(name);
  return names;
}

// Writes rows, and clears them: the destructor must not write them again if the
// other file cannot be written.
void Write(const std::filesystem::path& file, std::string* rows,
           std::ofstream* stream) {
  *stream << *rows << std::flush;
  if (!*stream) ThrowNotWritten(file);
  rows->clear();
}

std::ofstream Open(const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) ThrowNotWritten(file);
  return stream;
}

}  // namespace

std::string_view StatusName(TickStatus status) {
  switch (status) {
    case TickStatus::kOk:
      return "ok";
    case TickStatus::kLimitRelaxed:
      return "limit_relaxed";
    case TickStatus::kTruncated:
      return "truncated";
    case TickStatus::kFailSafe:
      return "fail_safe";
  }
  return "";
}

std::string_view ReasonName(FailSafeReason reason) {
  switch (reason) {
    case FailSafeReason::kNone:
      return "";
    case FailSafeReason::kState:
      return "state";
    case FailSafeReason::kClock:
      return "clock";
    case FailSafeReason::kNoAnswer:
      return "no_answer";
  }
  return "";
}

std::string_view PhaseName(ContactPhase phase) {
  switch (phase) {
    case ContactPhase::kDown:
      return "down";
    case ContactPhase::kUnloading:
      return "unloading";
    case ContactPhase::kUp:
      return "up";
    case ContactPhase::kLanding:
      return "landing";
    case ContactPhase::kLoading:
      return "loading";
    case ContactPhase::kLost:
      return "lost";
    case ContactPhase::kFree:
      return "free";
    case ContactPhase::kStepping:
      return "stepping";
    case ContactPhase::kReturning:
      return "returning";
  }
  return "";
}

Recorder::Recorder(const std::filesystem::path& folder, const Robot& robot,
                   const Stack& stack, LogFormat format)
    : body_names_(BodyNames(robot.model.tree)),
      num_levels_(LastLevel(stack)),
      rows_(MakeLogRows(format, Columns(robot, stack))),
      log_file_(folder / LogFileName(format)) {
  MakeFolder(folder);
  // Nothing of an earlier run is removed before both files can be written.
  RequireWritable(log_file_);
  RequireWritable(TimingFile());
  // Readers would mistake the log of an earlier run for the log of this run.
  std::error_code error;
  for (const LogFormat other : {LogFormat::kCsv, LogFormat::kBinary}) {
    std::filesystem::remove(folder / LogFileName(other), error);
  }
  log_ = Open(log_file_);
  timing_ = Open(TimingFile());
  log_rows_ = rows_->Header();
  hash_.Update(log_rows_);
  timing_rows_ = "tick,us,iterations,modelled_us\n";
  Flush();
}

Recorder::~Recorder() {
  log_ << log_rows_;
  timing_ << timing_rows_;
}

std::filesystem::path Recorder::TimingFile() const {
  return log_file_.parent_path() / "timing.csv";
}

void Recorder::EndEntries() {
  rows_->Text(entries_);
  entries_.clear();
}

void Recorder::Entry(std::string_view name, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof(digits), value,
                                 std::chars_format::general, 4);
  if (!entries_.empty()) entries_ += ';';
  entries_ += LogName(std::string(name));
  entries_ += '=';
  entries_.append(digits, end.ptr);
}

void Recorder::ConflictCell(const TickRecord& record) {
  const double now = record.observation.time;
  const int level = now < next_conflict_ ? -1 : LevelNotMet(record);
  if (level >= 0) {
    next_conflict_ = now + kBetweenConflicts;
    for (const HierarchyRow& row : FindConflict(record.hierarchy, level)) {
      Entry(record.stack.RowName(row.level, row.row, row.equality, row.side),
            record.stack.priority_level(row.level));
    }
  }
  EndEntries();
}

void Recorder::TextCells(const TickRecord& record) {
  for (const auto& [a, b] : record.end.self_contacts) {
    if (!entries_.empty()) entries_ += ';';
    entries_ += body_names_[a] + "|" + body_names_[b];
  }
  EndEntries();
  rows_->Text(StatusName(record.report.status));
  for (const ActiveRow& active : record.report.active) {
    Entry(record.stack.RowName(active), active.multiplier);
  }
  EndEntries();
  for (const LostRow& lost : record.report.lost) {
    Entry(record.stack.task(lost.task).equality_names()[lost.row], lost.amount);
  }
  EndEntries();
  ConflictCell(record);
  const int feet = static_cast<int>(record.observation.feet.size());
  for (int i = 0; i < feet; ++i) {
    rows_->Text(PhaseName(record.stance.phase(i)));
  }
  rows_->Text(Reason(record));
}

void Recorder::PlanCells(const TickRecord& record) {
  const Gait* gait = record.gait;
  const bool swings = gait != nullptr && gait->phase() == GaitPhase::kSwing;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 2; ++i) {
    rows_->Number(swings ? gait->goal_W()[i] : kNone);
  }
  rows_->Number(swings ? gait->remaining() : kNone);
  rows_->Number(swings ? gait->beyond_edge() : kNone);
}

void Recorder::Record(const TickRecord& record) {
  const Observation& now = record.observation;
  const auto vector = [this](const auto& v) {
    for (const double x : v) rows_->Number(x);
  };
  rows_->Number(now.time);
  vector(record.start.q.head<7>());
  rows_->Number(now.base_tilt);
  vector(now.com);
  vector(now.com_ref);
  vector(now.cop);
  for (const FootObservation& foot : now.feet) {
    rows_->Number(foot.down ? 1 : 0);
    rows_->Number(foot.tilt);
    rows_->Number(foot.slide);
    vector(foot.F_Co_C);
  }
  vector(record.push_force_W);
  vector(record.end.other_force_W);
  rows_->Number(static_cast<double>(record.end.self_contacts.size()));
  vector(record.end.tau);
  vector(record.start.q.tail(record.end.tau.size()));
  for (size_t i = 0; i < now.feet.size(); ++i) {
    vector(record.report.foot_wrench(record.nv, static_cast<int>(i)));
  }
  for (const TaskReport& task : record.report.tasks) {
    rows_->Number(task.residual);
  }
  vector(now.com_velocity);
  vector(now.xi);
  for (const FootObservation& foot : now.feet) vector(foot.X_WC.p);
  PlanCells(record);
  for (int i = 0; i < num_levels_; ++i) rows_->Number(record.report.gap[i]);
  TextCells(record);
  const size_t before = log_rows_.size();
  rows_->EndRow(&log_rows_);
  hash_.Update(std::string_view(log_rows_).substr(before));

  const auto append_us = [this](double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value,
                                   std::chars_format::fixed, 2);
    timing_rows_.append(digits, end.ptr);
  };
  timing_rows_ += std::to_string(record.tick) + ',';
  append_us(record.microseconds);
  timing_rows_ += ',' + std::to_string(record.report.iterations) + ',';
  append_us(1e6 * record.report.modelled_seconds);
  timing_rows_ += '\n';
  if (++rows_waiting_ >= kRowsAtOnce) Flush();
}

void Recorder::Flush() {
  rows_waiting_ = 0;
  Write(log_file_, &log_rows_, &log_);
  Write(TimingFile(), &timing_rows_, &timing_);
}

}  // namespace poise
