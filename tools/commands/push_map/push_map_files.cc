// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/push_map/push_map_files.h"

#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "poise/robot/output_file.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

constexpr char kMapHeader[] =
    "direction_deg,duration_s,tasks,impulse_Ns,lipm_Ns,lipm_height_Ns,eta";
constexpr char kStepsHeader[] = ",steps,step_Ns,eta_step,holes,first_step_Ns";
constexpr char kTrialsHeader[] =
    "direction_deg,duration_s,tasks,impulse_Ns,recovered,steps\n";

// Returns the shortest text that reads back as the same number.
std::string Text(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  return {digits, end.ptr};
}

std::string Text(const PushMapPoint& point) {
  return Text(point.direction_deg) + ',' + Text(point.duration) + ',' +
         point.tasks + ',';
}

std::string ReadAll(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string Text(const PushMapTrial& trial) {
  return (trial.recovered ? ",1," : ",0,") + std::to_string(trial.steps) + '\n';
}

std::string MapHeader(bool with_steps) {
  return std::string(kMapHeader) + (with_steps ? kStepsHeader : "") + '\n';
}

// Returns the cells of a point in a map with steps. Semicolons separate holes.
std::string StepCells(const PushMapValue& value) {
  const PushMapValue::Steps& steps = *value.steps;
  std::string text = ',' + std::to_string(steps.count) + ',' +
                     Text(steps.step_Ns) + ',' +
                     Text(value.impulse / steps.step_Ns) + ',';
  for (std::size_t i = 0; i < steps.holes.size(); ++i) {
    text += (i > 0 ? ";" : "") + Text(steps.holes[i]);
  }
  return text + ',' + Text(steps.first);
}

// Returns the rows as lists of cells, without header lines. Joined maps may
// have header lines in the middle.
std::vector<std::vector<std::string>> Rows(const fs::path& file,
                                           const std::string& header) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream stream(ReadAll(file));
  std::string line;
  while (std::getline(stream, line) && !stream.eof()) {
    if (line + '\n' == header) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) {
      cells.push_back(cell);
    }
    rows.push_back(cells);
  }
  return rows;
}

double Number(const std::string& text, const fs::path& file) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::invalid_argument(file.string() + ": '" + text +
                                "' must be a number");
  }
  return value;
}

PushMapPoint PointOf(const std::vector<std::string>& cells, size_t wanted,
                     const fs::path& file) {
  if (cells.size() != wanted) {
    throw std::invalid_argument(file.string() + ": a row has " +
                                std::to_string(cells.size()) +
                                " cells, must have " + std::to_string(wanted));
  }
  return {Number(cells[0], file), Number(cells[1], file), cells[2]};
}

PushMapValue::Steps StepsOf(const std::vector<std::string>& cells,
                            const fs::path& file) {
  PushMapValue::Steps steps;
  steps.count = static_cast<int>(Number(cells[7], file));
  steps.step_Ns = Number(cells[8], file);
  std::istringstream holes(cells[10]);
  for (std::string hole; std::getline(holes, hole, ';');) {
    steps.holes.push_back(Number(hole, file));
  }
  steps.first = Number(cells[11], file);
  return steps;
}

}  // namespace

PushMapFiles::PushMapFiles(const fs::path& folder, const std::string& settings,
                           bool header, bool with_steps)
    : folder_(folder), header_(header), with_steps_(with_steps) {
  MakeFolder(folder);
  const fs::path settings_file = folder / "settings.txt";
  const std::string text = settings + '\n';
  if (fs::exists(settings_file) && ReadAll(settings_file) != text) {
    throw std::invalid_argument(folder.string() +
                                ": has a map with other settings, see "
                                "settings.txt; choose another --out");
  }
  WriteFile(settings_file, text);
  const fs::path map = folder / "map.csv", trials = folder / "trials.csv";
  for (const auto& cells : Rows(map, MapHeader(with_steps))) {
    // PointOf() checks the number of cells.
    const PushMapPoint point = PointOf(cells, with_steps ? 12 : 7, map);
    found_[point] = {Number(cells[3], map), Number(cells[4], map),
                     Number(cells[5], map)};
    if (with_steps) found_[point].steps = StepsOf(cells, map);
  }
  for (const auto& cells : Rows(trials, kTrialsHeader)) {
    const PushMapPoint point = PointOf(cells, 6, trials);
    tried_[point][Number(cells[3], trials)] = {
        cells[4] == "1", static_cast<int>(Number(cells[5], trials))};
  }
  WriteMap();
  WriteTrials();
}

std::optional<PushMapValue> PushMapFiles::Found(
    const PushMapPoint& point) const {
  const std::lock_guard lock(mutex_);
  const auto found = found_.find(point);
  if (found == found_.end()) return std::nullopt;
  return found->second;
}

std::optional<PushMapTrial> PushMapFiles::Tried(const PushMapPoint& point,
                                                double impulse) const {
  const std::lock_guard lock(mutex_);
  const auto tried = tried_.find(point);
  if (tried == tried_.end()) return std::nullopt;
  const auto trial = tried->second.find(impulse);
  if (trial == tried->second.end()) return std::nullopt;
  return trial->second;
}

void PushMapFiles::AddFound(const PushMapPoint& point,
                            const PushMapValue& value) {
  const std::lock_guard lock(mutex_);
  found_[point] = value;
  WriteMap();
}

void PushMapFiles::AddTried(const PushMapPoint& point, double impulse,
                            const PushMapTrial& trial) {
  const std::lock_guard lock(mutex_);
  tried_[point][impulse] = trial;
  const fs::path file = folder_ / "trials.csv";
  std::ofstream stream(file, std::ios::app);
  if (!(stream << Text(point) + Text(impulse) + Text(trial) << std::flush)) {
    ThrowNotWritten(file);
  }
}

std::map<PushMapPoint, PushMapValue> PushMapFiles::found() const {
  const std::lock_guard lock(mutex_);
  return found_;
}

// Writes the whole map again, in order of its points. It has a few dozen lines,
// and results come in any order.
void PushMapFiles::WriteMap() const {
  std::string text = header_ ? MapHeader(with_steps_) : "";
  for (const auto& [point, value] : found_) {
    text += Text(point) + Text(value.impulse) + ',' + Text(value.lipm) + ',' +
            Text(value.lipm_height) + ',' + Text(value.impulse / value.lipm) +
            (with_steps_ ? StepCells(value) : "") + '\n';
  }
  WriteFile(folder_ / "map.csv", text);
}

void PushMapFiles::WriteTrials() const {
  std::string text = kTrialsHeader;
  for (const auto& [point, trials] : tried_) {
    for (const auto& [impulse, trial] : trials) {
      text += Text(point) + Text(impulse) + Text(trial);
    }
  }
  WriteFile(folder_ / "trials.csv", text);
}

std::string TaskSetName(const std::vector<std::string>& with,
                        const std::vector<std::string>& without) {
  std::string name;
  for (const std::string& task : without) name += '-' + task;
  for (const std::string& task : with) name += '+' + task;
  return name.empty() ? "default" : name;
}

}  // namespace poise
