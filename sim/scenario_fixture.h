// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Reads scenarios from text.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "poise/sim/scenario.h"
#include "poise/tests/util/test_file.h"

namespace poise {

inline std::filesystem::path Write(const std::string& text) {
  return TestFile("trial.yaml", text);
}

inline Scenario Read(const std::string& text) {
  return LoadScenario(Write(text));
}

// Returns the error message of a scenario, after the folder's name.
inline std::string Complaint(const std::string& text) {
  try {
    Read(text);
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    const size_t start = what.find("trial.yaml");
    return start == std::string::npos ? what : what.substr(start);
  }
  return "none";
}

}  // namespace poise
