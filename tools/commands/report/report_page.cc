// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/report_page.h"

#include <optional>
#include <stdexcept>

#include "poise/robot/output_file.h"
#include "poise/sim/log/open_log.h"
#include "poise/sim/log/parse_json.h"
#include "poise/sim/log/run_summary.h"
#include "poise/tools/commands/report/add_meshes.h"
#include "poise/tools/commands/report/run_log.h"
#include "poise/tools/viewer/pages.h"

namespace poise {
namespace {

using nlohmann::json;
using std::filesystem::path;

// Marks the place in the page where the data are inserted.
constexpr std::string_view kPlaceholder = "\"POISE-DATA\"";

// Reads the file robot.json of a run, which may be missing: then adds a note
// and returns null.
json ReadRobotJson(const path& run_dir, json* notes) {
  const path file = run_dir / "robot.json";
  if (std::filesystem::exists(file)) {
    return ReadJsonOfRun(file,
                         "run push again, or remove this file to see the run "
                         "without its robot");
  }
  notes->push_back("robot.json is missing.");
  return nullptr;
}

double ControlPeriod(const json& summary) {
  constexpr double kUsual = 1e-3;
  if (!summary.is_object()) return kUsual;
  const auto dt = summary.find("control_dt");
  return dt != summary.end() && dt->is_number() ? dt->get<double>() : kUsual;
}

// Removes the notes from the result of ReadRunLog() and returns them.
json TakeNotes(json* log) {
  json notes = std::move((*log)["notes"]);
  log->erase("notes");
  return notes;
}

// Returns null if there is no timing.csv.
json ReadTimingOf(const path& run_dir, const json& summary,
                  std::optional<long> num_rows) {
  const path file = run_dir / "timing.csv";
  if (!std::filesystem::exists(file)) return nullptr;
  return ReadTiming(file, ControlPeriod(summary), num_rows);
}

// Returns the name of a run, which is the name of its folder.
std::string NameOf(const path& run_dir) {
  path name = std::filesystem::absolute(run_dir).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  return name.filename().string();
}

void WritePage(json runs, const path& html) {
  const std::string page = FillPage(
      kReportPage, {{"format", "poise-report-1"}, {"runs", std::move(runs)}});
  if (html.has_parent_path()) MakeFolder(html.parent_path());
  WriteFile(html, page);
}

void ReplaceAll(std::string_view from, std::string_view to, std::string* text) {
  for (std::size_t at = text->find(from); at != std::string::npos;
       at = text->find(from, at + to.size())) {
    text->replace(at, from.size(), to);
  }
}

}  // namespace

json ReadRun(const path& run_dir) {
  json log = ReadRunLog(FindLog(run_dir));
  json notes = TakeNotes(&log);
  RunSummary read = ReadRunSummary(run_dir);
  if (!read.note.empty()) notes.push_back(read.note);
  json summary = std::move(read.values);
  json robot = ReadRobotJson(run_dir, &notes);
  json timing = ReadTimingOf(run_dir, summary, {});
  return {{"name", NameOf(run_dir)},     {"summary", std::move(summary)},
          {"robot", std::move(robot)},   {"log", std::move(log)},
          {"timing", std::move(timing)}, {"notes", std::move(notes)}};
}

json ReadRun(const RunFiles& run) {
  json log = ReadRunLog(FindLog(run.folder), run.num_rows);
  json notes = TakeNotes(&log);
  return {{"name", NameOf(run.folder)},
          {"summary", run.summary},
          {"robot", run.robot},
          {"log", std::move(log)},
          {"timing", ReadTimingOf(run.folder, run.summary, run.num_rows)},
          {"notes", std::move(notes)}};
}

std::string FillPage(std::string_view page, const json& document) {
  std::string data = document.dump(-1, ' ', /*ensure_ascii=*/false,
                                   json::error_handler_t::replace);
  // In JSON only strings may contain '<', and strings may contain this escape.
  ReplaceAll("<", "\\u003c", &data);
  const std::size_t at = page.find(kPlaceholder);
  if (at == std::string_view::npos) {
    throw std::logic_error("the page has no place for data");
  }
  std::string filled(page.substr(0, at));
  filled += data;
  filled += page.substr(at + kPlaceholder.size());
  return filled;
}

std::vector<std::string> WriteReport(const std::vector<path>& run_dirs,
                                     const path& html,
                                     const std::vector<path>& packages) {
  if (run_dirs.empty() || run_dirs.size() > 2) {
    throw std::invalid_argument("a report must show one run or two, not " +
                                std::to_string(run_dirs.size()));
  }
  json runs = json::array();
  std::vector<std::string> notes;
  for (const path& run_dir : run_dirs) {
    runs.push_back(ReadRun(run_dir));
    for (const json& note : runs.back()["notes"]) {
      notes.push_back(run_dir.string() + ": " + note.get<std::string>());
    }
    if (!packages.empty()) AddMeshes(packages, &runs.back()["robot"]);
  }
  WritePage(std::move(runs), html);
  return notes;
}

void WriteRunReport(const RunFiles& run, const path& html) {
  WritePage(json::array({ReadRun(run)}), html);
}

}  // namespace poise
