// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Draws hierarchies, compares the two solvers and the certificate, and writes
// each failure, shrunk, as a file that //tools:hqp replays, or as some that it
// replays in their order where only a solver that has solved others fails:
//   bazel run //tests:hqp_night -- --problems 100000 --seed 1 --out DIR
#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "poise/hqp/solver.h"
#include "poise/tests/util/compare_solvers.h"
#include "poise/tests/util/shrink_hierarchy.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

struct Night {
  std::uint64_t problems = 100000;
  std::uint64_t seed = 1;
  std::string out = ".";
  double tolerance = 1e-9;
  int ticks = 1;
  RandomHierarchyOptions options;
};

// What a disagreement is about: its first words, without numbers. A failure
// shrinks to one of its own kind.
std::string Kind(const std::string& disagreement) {
  return disagreement.substr(0, disagreement.find_first_of("0123456789;"));
}

std::string Write(const std::filesystem::path& path,
                  const HierarchyCase& drawn) {
  std::ofstream file(path);
  if (!(file << WriteHqp(drawn.hierarchy) << "\n")) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
  return " " + path.string();
}

// What a new solver gets wrong as well is shrunk, and written, alone; else it is
// with the ticks before it, in the order of their files, as the living solver's
// history matters.
void Report(const Night& night, std::uint64_t seed,
            const std::string& disagreement, std::vector<HierarchyCase> ticks) {
  const size_t tick = ticks.size() - 1;
  if (!Disagreement(ticks.back(), night.tolerance).empty()) {
    ticks = {ticks.back()};
  }
  const std::string kind = Kind(DisagreementAfter(ticks, night.tolerance));
  ticks = ShrinkTicks(ticks, [&](const std::vector<HierarchyCase>& each) {
    return Kind(DisagreementAfter(each, night.tolerance)) == kind;
  });
  const std::filesystem::path folder = UserPath(night.out);
  std::filesystem::create_directories(folder);
  const std::string name = "hqp_" + std::to_string(seed);
  std::string files;
  if (ticks.size() == 1) {
    files = Write(folder / (name + ".json"), ticks.front());
  } else {
    // A budget as the living solver has it.
    files = " --max-iterations " + std::to_string(Solver(1, {}).max_iterations);
    for (size_t t = 0; t < ticks.size(); ++t) {
      files +=
          Write(folder / (name + "_" + std::to_string(t) + ".json"), ticks[t]);
    }
  }
  std::cout << "seed " << seed << ", tick " << tick << ": " << disagreement
            << "\n  shrunk: " << DisagreementAfter(ticks, night.tolerance)
            << "\n  bazel run //tools:hqp --" << files << std::endl;
}

int Main(int argc, char** argv) {
  Night night;
  CLI::App app("Compares the two solvers on random hierarchies.", "hqp_night");
  app.option_defaults()->always_capture_default();
  app.add_option("--problems", night.problems, "How many to draw");
  app.add_option("--seed", night.seed, "Of the first; the next has the next");
  app.add_option("--out", night.out, "The folder for failures");
  app.add_option("--tolerance", night.tolerance, "0 makes all rounding fail");
  app.add_option("--variables", night.options.max_variables, "At most");
  app.add_option("--levels", night.options.max_levels, "At most");
  app.add_option("--equalities", night.options.max_equalities,
                 "Of a level, at most");
  app.add_option("--inequalities", night.options.max_inequalities,
                 "Of a level, at most");
  app.add_option("--degenerate", night.options.degenerate,
                 "Rows that are zero or depend on others, in percent");
  app.add_option("--planted", night.options.planted,
                 "Rows that meet in one point, in percent");
  app.add_option("--scaled", night.options.scaled,
                 "Hierarchies of rows from 1e-3 to 1e6, in percent");
  app.add_option("--weighted", night.options.weighted,
                 "Hierarchies with weights of many sizes, in percent");
  app.add_option("--decades", night.options.decades,
                 "Those weights are from 1e-decades to 1e+decades");
  app.add_option("--degenerate-vertex", night.options.degenerate_vertex,
                 "Hierarchies whose bounds are all zero, in percent");
  app.add_option(
      "--integer", night.options.integer,
      "Hierarchies of small whole numbers whose rows meet where many "
      "coordinates are 0, in percent");
  app.add_option(
      "--columns", night.options.columns,
      "Hierarchies of variables in units from 1e-3 to 1e6, in percent");
  app.add_option("--ticks", night.ticks,
                 "Ticks of one solver, in which each hierarchy changes");
  app.add_option("--selecting", night.options.selecting,
                 "Hierarchies whose last levels select, in percent");
  ParseCommandLine(argc, argv, &app);
  std::uint64_t failures = 0;
  for (std::uint64_t i = 0; i < night.problems; ++i) {
    const std::uint64_t seed = night.seed + i;
    HierarchyCase drawn =
        WithRoomToChange(MakeRandomHierarchy(seed, night.options));
    Solver living(drawn.hierarchy.num_variables(), drawn.capacity);
    std::vector<HierarchyCase> ticks;
    for (int tick = 0; tick < night.ticks; ++tick) {
      if (tick > 0) ChangeHierarchy(seed * night.ticks + tick, &drawn);
      ticks.push_back(drawn);
      const std::string found =
          Disagreement(drawn, night.tolerance, tick > 0 ? &living : nullptr);
      if (tick == 0) {
        Solution solution(drawn.hierarchy.num_variables(), drawn.capacity);
        (void)living.Solve(drawn.hierarchy, &solution);
      }
      if (found.empty()) continue;
      ++failures;
      Report(night, seed, found, ticks);
      break;
    }
  }
  std::cout << night.problems << " hierarchies from seed " << night.seed << ": "
            << failures << " failures\n";
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("hqp_night", [=] { return poise::Main(argc, argv); });
}
