// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace poise {

/// Number of files in //sim:scenarios. A test that goes through ScenarioFiles()
/// asserts that it has seen this number.
constexpr int kNumScenarios = 10;

/// Returns the paths of //sim:scenarios, sorted. The scenarios must be in the
/// test's data.
std::vector<std::string> ScenarioFiles();

/// Returns the test name of a scenario: the file's name without folder and
/// extension.
std::string ScenarioTestName(const testing::TestParamInfo<std::string>& file);

}  // namespace poise
