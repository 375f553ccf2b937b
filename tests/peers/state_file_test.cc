// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/state_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

#include "poise/tests/util/random_tree.h"

namespace poise {
namespace {

std::vector<State> MakeStates() {
  std::mt19937 draw(1);
  std::vector<State> states;
  for (int i = 0; i < 3; ++i) {
    states.push_back(
        {1e-3 * i, MakeRandomVector(9, &draw), MakeRandomVector(8, &draw)});
  }
  return states;
}

TEST(StateFile, KeepsAllBits) {
  const std::vector<State> states = MakeStates();
  const std::string path = testing::TempDir() + "/states";
  WriteStates(states, path);
  const std::vector<State> read = ReadStates(path);
  ASSERT_EQ(read.size(), states.size());
  for (size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].time, states[i].time);
    EXPECT_EQ(read[i].q, states[i].q);
    EXPECT_EQ(read[i].v, states[i].v);
  }
}

TEST(StateFile, RejectsFileThatEndsEarly) {
  const std::string path = testing::TempDir() + "/short_states";
  WriteStates(MakeStates(), path);
  std::ifstream in(path);
  std::string head, first, second;
  std::getline(in, head);
  std::getline(in, first);
  std::getline(in, second);
  std::ofstream(path) << head << '\n' << first << '\n' << second << '\n';
  EXPECT_THROW(ReadStates(path), std::invalid_argument);
}

TEST(StateFile, RejectsFileOfAnotherFormat) {
  const std::string path = testing::TempDir() + "/other_format";
  std::ofstream(path) << "poise-tree-1 1 9 8\n";
  EXPECT_THROW(ReadStates(path), std::invalid_argument);
}

TEST(StateFile, RejectsFileWithoutStates) {
  const std::string path = testing::TempDir() + "/no_states";
  std::ofstream(path) << "poise-states-1 0 9 8\n";
  EXPECT_THROW(ReadStates(path), std::invalid_argument);
}

}  // namespace
}  // namespace poise
