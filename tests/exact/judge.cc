// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Draws small hierarchies and compares both solvers with the exact optimum. The
// first that differs is shrunk and written as a file that //tools:hqp replays.
//   bazel run //tests/exact:judge -- --problems 10000 --seed 1 --out DIR
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>

#include "poise/robot/output_file.h"
#include "poise/tests/exact/exact_difference.h"
#include "poise/tests/exact/small_hierarchy.h"
#include "poise/tests/util/shrink_hierarchy.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/hqp/hqp_file.h"
#include "poise/tools/commands/output_folder.h"

namespace poise {
namespace {

// Shrinks a hierarchy that differs, and writes it into the folder.
void Report(const HierarchyCase& drawn, std::uint64_t seed,
            const std::string& out) {
  const HierarchyCase small = ShrinkHierarchy(drawn, [](const auto& each) {
    return !DifferenceFromExact(each).empty();
  });
  const std::filesystem::path path =
      MakeOutputFolder(out) / ("exact_" + std::to_string(seed) + ".json");
  WriteFile(path, WriteHqp(small.hierarchy) + "\n");
  std::cout << "  shrunk: " << DifferenceFromExact(small)
            << "\n  bazel run //tools:hqp -- " << path.string() << std::endl;
}

int Main(int argc, char** argv) {
  std::uint64_t problems = 10000, seed = 1;
  std::string out = "hqp-exact";
  CLI::App app("Compares the two solvers with exact optima.", "judge");
  app.option_defaults()->always_capture_default();
  app.add_option("--problems", problems, "Number of hierarchies to draw")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
  app.add_option("--seed", seed,
                 "Seed of the first hierarchy; each further one adds 1");
  app.add_option("--out", out,
                 "Folder for the file of the first hierarchy that differs");
  ParseCommandLine(argc, argv, &app);
  std::uint64_t differ = 0;
  for (std::uint64_t i = 0; i < problems; ++i) {
    const HierarchyCase drawn = MakeSmallHierarchy(seed + i);
    const std::string difference = DifferenceFromExact(drawn);
    if (!difference.empty()) {
      std::cout << "seed " << seed + i << ": " << difference << std::endl;
      if (++differ == 1) Report(drawn, seed + i, out);
    }
    if ((i + 1) % 1000 == 0) {
      std::cerr << i + 1 << " of " << problems << ", " << differ << " differ\n";
    }
  }
  std::cout << problems << " hierarchies, " << differ << " differ\n";
  return differ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("judge", [=] { return poise::Main(argc, argv); });
}
