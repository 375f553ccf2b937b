// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/interrupt.h"
#include "poise/python/python_robot.h"
#include "poise/python/python_task.h"
#include "poise/robot/mesh/read_visuals.h"
#include "poise/sim/closed_loop.h"
#include "poise/sim/experiment.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/log/open_log.h"
#include "poise/sim/log/summary.h"
#include "poise/sim/scenario.h"
#include "poise/tools/commands/explain/explanation.h"
#include "poise/tools/commands/push/record_run.h"
#include "poise/tools/commands/report/report_page.h"

namespace poise {
namespace {

// Runs a scenario as //tools:push does. Returns the table that push prints.
// Ctrl-C stops the run and raises KeyboardInterrupt.
std::string Record(const PythonRobot& robot, const Scenario& scenario,
                   py::handle folder, py::handle binary, py::handle meshes,
                   py::handle tasks) {
  const std::filesystem::path out = AsText(folder, "out");
  const LogFormat format =
      AsFlag(binary, "binary") ? LogFormat::kBinary : LogFormat::kCsv;
  const bool reads_meshes = AsFlag(meshes, "meshes");
  Scenario with_tasks = scenario;
  UseTasksOf(robot.profile, &with_tasks);
  const auto add_tasks = TasksToAdd(tasks);
  std::string table;
  ForgetInterrupt();
  {
    const py::gil_scoped_release release;
    Robot drawn = *robot.robot;
    if (reads_meshes) ReadVisuals(&drawn.model);
    ClosedLoop loop(drawn, with_tasks, add_tasks);
    InterruptCheck check;
    const double ticks = with_tasks.duration / with_tasks.control.dt;
    const auto goes_on = [&check, ticks](double fraction) {
      return !check.Look(std::lround(fraction * ticks));
    };
    const RunRecord record = RecordRun(&loop, out, goes_on, format);
    table =
        ToTable(loop.robot(), loop.scenario(), record.result, record.step_Ns);
  }
  RaiseInterrupt();
  return table;
}

// The columns of a log: numbers, or texts.
struct LogData {
  std::vector<std::string> names;
  std::vector<std::vector<double>> numbers;
  std::vector<std::vector<std::string>> texts;
};

LogData ReadColumns(const std::filesystem::path& folder) {
  const auto log = OpenLog(FindLog(folder));
  LogData data;
  data.names = log->columns();
  const int size = static_cast<int>(data.names.size());
  data.numbers.resize(size);
  data.texts.resize(size);
  std::vector<bool> is_text;
  for (const std::string& name : data.names) {
    is_text.push_back(GroupOf(name) == ColumnGroup::kText);
  }
  while (log->Next()) {
    for (int i = 0; i < size; ++i) {
      if (is_text[i]) {
        data.texts[i].emplace_back(log->cell(i));
      } else {
        data.numbers[i].push_back(log->Number(i));
      }
    }
  }
  return data;
}

py::dict ReadLog(py::handle folder) {
  const std::string name = AsText(folder, "folder");
  LogData data;
  {
    const py::gil_scoped_release release;
    data = ReadColumns(name);
  }
  py::dict columns;
  for (size_t i = 0; i < data.names.size(); ++i) {
    const bool is_text = GroupOf(data.names[i]) == ColumnGroup::kText;
    if (is_text) {
      columns[py::str(data.names[i])] = data.texts[i];
    } else {
      columns[py::str(data.names[i])] =
          py::array_t<double>(static_cast<py::ssize_t>(data.numbers[i].size()),
                              data.numbers[i].data());
    }
  }
  return columns;
}

std::string ExplainRun(py::handle folder) {
  const std::string name = AsText(folder, "folder");
  const py::gil_scoped_release release;
  return Explain(name).dump();
}

void WriteRunPage(py::handle folders, py::handle file, py::handle packages) {
  std::vector<std::filesystem::path> runs;
  for (const std::string& run : AsTexts(folders, "folders")) {
    runs.emplace_back(run);
  }
  const std::string html = AsText(file, "file");
  const std::vector<std::string> search = AsTexts(packages, "packages");
  const py::gil_scoped_release release;
  WriteReport(runs, html, {search.begin(), search.end()});
}

}  // namespace

void BindRun(py::module_* module) {
  module->def("_record", Record, py::arg("robot"), py::arg("scenario"),
              py::arg("folder"), py::arg("binary"), py::arg("meshes"),
              py::arg("tasks"));
  module->def("_read_log", ReadLog, py::arg("folder"));
  module->def("_explain", ExplainRun, py::arg("folder"));
  module->def("_write_report", WriteRunPage, py::arg("folders"),
              py::arg("file"), py::arg("packages"));
}

}  // namespace poise
