// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Writes docs/generated/accuracy.md: bazel run //math:accuracy
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "poise/math/measure_accuracy.h"

int main(int argc, char** argv) {
  constexpr int kSamples = 50;
  const char* workspace = std::getenv("BUILD_WORKSPACE_DIRECTORY");
  if (workspace == nullptr && argc < 2) {
    std::cerr << "usage: bazel run //math:accuracy, or accuracy FILE\n";
    return 2;
  }
  const std::string path =
      argc > 1 ? argv[1]
               : std::string(workspace) + "/docs/generated/accuracy.md";
  // Before the file is opened, and so emptied: it takes a minute.
  const auto rows = poise::MeasureAccuracy(kSamples);
  std::ofstream file(path);
  file
      << R"(# Accuracy of the maps of SO(3) and SE(3)

Written by `bazel run //math:accuracy`. Do not edit.

The largest error of each map on each range of angles, in eps = 2.2e-16, among
)" << kSamples
      << R"( random arguments, against power series in 400 bits. What is compared
with what, and divided by which condition, is said in
[math/measure_accuracy.h](../../math/measure_accuracy.h); the bars are tested by
`//math:measure_accuracy_test`, with fewer arguments. The input of a logarithm
is the exact rotation rounded to double, and its error includes that rounding.

Where the maps switch from series to closed form, |w|² = 2.5, and why, is
said in [math/stumpff.h](../../math/stumpff.h).

)";
  poise::WriteAccuracy(rows, file);
  file.close();
  if (!file) {
    std::cerr << "cannot write " << path << '\n';
    return 1;
  }
  std::cout << "wrote " << path << '\n';
}
