// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/command_line.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace poise {
namespace {

// Returns the message with which a command line is rejected, or "accepted".
std::string Refusal(std::vector<std::string> words) {
  words.insert(words.begin(), "program");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  CLI::App app("A program with an option of each kind.");
  double force = 0, time = 0, late = 0;
  int count = 0;
  std::string plant, friction;
  std::vector<double> point;
  std::vector<double> runs;
  std::string file;
  bool json = false;
  std::optional<bool> clock;
  app.add_option("--force", force);
  app.add_option("--point", point)->delimiter(',')->expected(3);
  app.add_option("--plant", plant)->check(CLI::IsMember({"bullet", "mujoco"}));
  app.add_option("--friction-pyramid,--friction", friction)
      ->check(CLI::IsMember({"in", "out"}));
  app.add_option("--count", count)->check(CLI::Range(1, 3600));
  CLI::Option* const dump =
      app.add_option("--time", time)->check(CLI::Range(0.0, 1e6));
  app.add_option("--late", late)->needs(dump);
  app.add_flag("--json", json)->excludes(dump);
  app.add_flag("--clock", clock);
  app.add_option("--runs", runs)->delimiter(',')->expected(1, 2);
  app.add_option("file", file)->required();
  try {
    ParseCommandLine(static_cast<int>(argv.size()), argv.data(), &app);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseCommandLine, AcceptsValidWords) {
  EXPECT_EQ(Refusal({"a", "--force", "1e-3", "--point", "1,2,3", "--json",
                     "--clock", "--count=7"}),
            "accepted");
  EXPECT_EQ(Refusal({"a", "--json=false", "--clock=true"}), "accepted");
}

TEST(ParseCommandLine, NamesOptionValueAndWhatIsWanted) {
  const struct {
    std::vector<std::string> words;
    std::string message;
  } cases[] = {
      {{"--force", "x"}, "--force is 'x', must be a number"},
      {{"--force", "1", "--force", "2"},
       "--force is given 2 times, must be given once"},
      {{"--force"}, "--force has no value, must have 1 value"},
      {{"--point", "1,2"}, "--point has 2 values, must have 3 values"},
      {{"--point", "1,2,3,4"}, "--point has 4 values, must have 3 values"},
      {{"--point", "1,x,3"}, "--point is '1,x,3', must be numbers"},
      {{"--point", "1,,3"},
       "--point is '1,,3', must have an entry before and after each comma"},
      {{"--point", "1,2,3,"},
       "--point is '1,2,3,', must have an entry before and after each comma"},
      {{"--point=,1,2"},
       "--point is ',1,2', must have an entry before and after each comma"},
      {{"--point=1,2,,3"},
       "--point is '1,2,,3', must have an entry before and after each comma"},
      {{"--point"}, "--point has no value, must have 3 values"},
      {{"--runs", "1,2,3"}, "--runs has 3 values, must have at most 2 values"},
      {{"--plant", "foo"}, "--plant is 'foo', must be bullet or mujoco"},
      {{"--friction-pyramid", "foo"},
       "--friction-pyramid is 'foo', must be in or out"},
      {{"--friction", "foo"}, "--friction is 'foo', must be in or out"},
      {{"--friction=foo"}, "--friction is 'foo', must be in or out"},
      {{"--count", "x"},
       "--count is 'x', must be a whole number from 1 to 3600"},
      {{"--count", "1.5"},
       "--count is '1.5', must be a whole number from 1 to 3600"},
      {{"--time=-1"}, "--time is '-1', must be a number from 0 to 1e+06"},
      {{"--late", "1"},
       "--late has an effect with --time only, give --time as well"},
      {{"--json", "--time", "1"},
       "--time and --json exclude each other, give one of them"},
      {{"--json=maybe"}, "--json is 'maybe', must be true or false"},
      {{"--clock=maybe"}, "--clock is 'maybe', must be true or false"},
      {{"--nope"}, "option '--nope' is unknown"},
      {{"b", "c"}, "'b' belongs to no option, see --help"},
      {{"--", "b", "c"}, "'b' belongs to no option, see --help"},
  };
  for (const auto& each : cases) {
    std::vector<std::string> words = {"a"};
    words.insert(words.end(), each.words.begin(), each.words.end());
    EXPECT_EQ(Refusal(words), each.message);
  }
  EXPECT_EQ(Refusal({}), "file is missing, see --help");
  EXPECT_EQ(Refusal({"--nope"}), "option '--nope' is unknown");
}

TEST(RunToolDeathTest, SaysThatItIsInterrupted) {
  EXPECT_EXIT((void)RunTool("figures", [] { return std::raise(SIGINT); }),
              testing::KilledBySignal(SIGINT), "figures: interrupted");
}

}  // namespace
}  // namespace poise
