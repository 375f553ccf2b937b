// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace poise {

/// How many files //sim:scenarios has: a test that goes through ScenarioFiles()
/// asserts that it has seen so many.
constexpr int kNumScenarios = 9;

/// The paths of //sim:scenarios, which must be in the test's data, by name.
std::vector<std::string> ScenarioFiles();

/// The name of the test that runs one of them: the file's, without a folder.
std::string ScenarioTestName(const testing::TestParamInfo<std::string>& file);

}  // namespace poise
