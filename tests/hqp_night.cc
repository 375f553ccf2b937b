// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Draws random hierarchies and compares the fast solver, the cascade and the
// certificate. Each failure is shrunk and written as a file that //tools:hqp
// replays. If only a solver that has solved other hierarchies fails, the
// failure is written as several files, which //tools:hqp replays in their
// order.
//   bazel run //tests:hqp_night -- --problems 100000 --seed 1 --out DIR
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "poise/hqp/solver.h"
#include "poise/robot/output_file.h"
#include "poise/tests/util/compare_solvers.h"
#include "poise/tests/util/shrink_hierarchy.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/output_folder.h"

namespace poise {
namespace {

struct Night {
  std::uint64_t problems = 100000;
  std::uint64_t seed = 1;
  std::string out = "hqp-night";
  double tolerance = 1e-9;
  int ticks = 1;
  RandomHierarchyOptions options;
};

// Returns the kind of a disagreement: its first words, without numbers. A
// failure is shrunk to a failure of the same kind.
std::string Kind(const std::string& disagreement) {
  return disagreement.substr(0, disagreement.find_first_of("0123456789;"));
}

std::string Write(const std::filesystem::path& path,
                  const HierarchyCase& drawn) {
  WriteFile(path, WriteHqp(drawn.hierarchy) + "\n");
  return " " + path.string();
}

// Shrinks and writes a failure. If a new solver also fails in the last tick,
// that tick is written alone. Otherwise only the warm solver fails, which has
// solved the ticks before, and these ticks are written as well, in the order of
// their files.
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
  const std::filesystem::path folder = MakeOutputFolder(night.out);
  const std::string name = "hqp_" + std::to_string(seed);
  std::string files;
  if (ticks.size() == 1) {
    files = Write(folder / (name + ".json"), ticks.front());
  } else {
    // The replay needs the same iteration limit as the warm solver.
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

// Adds the options about the hierarchies.
void AddHierarchyOptions(CLI::App* app, Night* night) {
  constexpr int kMost = 1000;  // Rows, columns, levels or ticks.
  app->add_option("--variables", night->options.max_variables,
                  "Largest number of variables")
      ->check(CLI::Range(1, kMost));
  app->add_option("--levels", night->options.max_levels,
                  "Largest number of levels")
      ->check(CLI::Range(1, kMost));
  app->add_option("--equalities", night->options.max_equalities,
                  "Largest number of equality rows of a level")
      ->check(CLI::Range(0, kMost));
  app->add_option("--inequalities", night->options.max_inequalities,
                  "Largest number of inequality rows of a level")
      ->check(CLI::Range(0, kMost));
  app->add_option("--degenerate", night->options.degenerate,
                  "Percentage of rows that are zero or depend on other rows");
  app->add_option("--planted", night->options.planted,
                  "Percentage of rows that meet in one point");
  app->add_option("--scaled", night->options.scaled,
                  "Percentage of hierarchies with rows scaled by 1e-3 to 1e6");
  app->add_option("--weighted", night->options.weighted,
                  "Percentage of hierarchies with weights of many sizes");
  app->add_option(
      "--decades", night->options.decades,
      "The weights of --weighted are from 1e-decades to 1e+decades");
  app->add_option("--degenerate-vertex", night->options.degenerate_vertex,
                  "Percentage of hierarchies whose bounds are all zero");
  app->add_option(
      "--integer", night->options.integer,
      "Percentage of hierarchies of small integers whose rows meet in a point "
      "where many coordinates are 0");
  app->add_option(
      "--columns", night->options.columns,
      "Percentage of hierarchies with variables in units from 1e-3 to 1e6");
  app->add_option("--bounds", night->options.bounds,
                  "Percentage of inequalities that bound one variable");
  app->add_option(
         "--ticks", night->ticks,
         "Number of ticks that one solver solves while its hierarchy changes")
      ->check(CLI::Range(1, kMost));
  app->add_option(
      "--selecting", night->options.selecting,
      "Percentage of hierarchies whose last levels only select variables");
}

int Main(int argc, char** argv) {
  Night night;
  CLI::App app("Compares the two solvers on random hierarchies.", "hqp_night");
  app.option_defaults()->always_capture_default();
  app.add_option("--problems", night.problems, "Number of hierarchies to draw")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
  app.add_option("--seed", night.seed,
                 "Seed of the first hierarchy; each further one adds 1");
  app.add_option("--out", night.out, "Folder for the files of failures");
  app.add_option(
      "--tolerance", night.tolerance,
      "Largest relative error; with 0 rounding errors count as failures");
  AddHierarchyOptions(&app, &night);
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
