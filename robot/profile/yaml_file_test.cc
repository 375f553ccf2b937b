// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/yaml_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <locale>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace poise {
namespace {

std::string Repeat(const std::string& text, int times) {
  std::string repeated;
  for (int i = 0; i < times; ++i) repeated += text;
  return repeated;
}

std::string Refusal(const std::string& text) {
  try {
    ParseYaml(text, "f");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseYaml, ReadsNestedMapsAndLists) {
  const YAML::Node root =
      ParseYaml("# Hello.\na: {b: [1, {c: d}]}\ne:\n  b: 2\n", "f");
  EXPECT_EQ(root["a"]["b"][1]["c"].Scalar(), "d");
  EXPECT_EQ(root["e"]["b"].as<int>(), 2);
  EXPECT_EQ(root["e"].Mark().line, 3);
}

TEST(ParseYaml, RejectsADuplicateKey) {
  EXPECT_EQ(Refusal("a: 1\nb: 2\na: 3\n"),
            "f:3: key 'a' occurs twice, must occur once");
  EXPECT_EQ(Refusal("a:\n  b: [x, x]\n  c: {b: 1,\n    b: 2}\n"),
            "f:4: key 'b' occurs twice, must occur once");
  EXPECT_EQ(Refusal("\"a\\nb\": 1\n\"a\\nb\": 1"),
            "f:2: key 'a b' occurs twice, must occur once");
  EXPECT_EQ(Refusal("a: {b: 1}\nc: {b: 1}\nb: a\n"), "accepted");
  EXPECT_EQ(Refusal("- {a: 1}\n- {a: 1}\n"), "accepted");
}

// The message gives the line of the key.
TEST(ParseYaml, RejectsAKeyWithoutAValue) {
  EXPECT_EQ(Refusal("a: 1\nb:\n\n# End.\n"),
            "f:2: key 'b' has no value, must have one");
  EXPECT_EQ(Refusal("a:\n  b:\nc: 1\n"),
            "f:2: key 'b' has no value, must have one");
  EXPECT_EQ(Refusal("a: {b: {c: 1}, d: }\n"),
            "f:1: key 'd' has no value, must have one");
  EXPECT_EQ(Refusal("a: ~\n"), "f:1: key 'a' has no value, must have one");
  EXPECT_EQ(Refusal("a: [~]\nb: \"\"\n"), "accepted");
}

TEST(ToNumber, ReadsOneFiniteNumber) {
  class Comma : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const YAML::Node root = ParseYaml(
      "[0.75, 1.234, -2e-3, +5, .nan, .inf, 1e999, '1 2', '', a, [1], 0x10, "
      "'1,5']",
      "f");
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new Comma));
  std::vector<std::optional<double>> numbers;
  for (const YAML::Node& node : root) numbers.push_back(ToNumber(node));
  std::locale::global(before);
  const std::vector<std::optional<double>> wanted = {
      0.75, 1.234, -2e-3, 5, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  EXPECT_EQ(numbers, wanted);
}

TEST(ParseYaml, RejectsInvalidAndUnsupportedDocuments) {
  EXPECT_EQ(Refusal("a: 1\n---\nb: 1\n"),
            "f:2: has a second document, must have one");
  EXPECT_EQ(Refusal(""), "f: is empty, must be a map");
  EXPECT_EQ(Refusal("# Only this.\n"), "f: is empty, must be a map");
  EXPECT_EQ(Refusal("a: &x 1\nb: *x\n"),
            "f:2: has an alias (*), must repeat the value instead");
  EXPECT_EQ(Refusal("a: &x\n  b: *x\n"),
            "f:2: has an alias (*), must repeat the value instead");
  EXPECT_EQ(Refusal("[a]: 1\n"),
            "f:1: has a key that is not a text, must be a text");
  EXPECT_EQ(Refusal("~: 1\n"),
            "f:1: has a key that is not a text, must be a text");
  EXPECT_EQ(Refusal(std::string("a: \0b", 5)),
            "f: is binary, must be UTF-8 text");
  EXPECT_EQ(Refusal(Repeat("- ", 10'000)), "f:1: is nested too deeply");
  EXPECT_EQ(Refusal("a: {b"),
            "f:1: is not valid YAML: end of map flow not found");
}

TEST(LoadYaml, RejectsMissingSpecialAndLargeFiles) {
  const std::string folder = std::getenv("TEST_TMPDIR");
  const auto refusal = [&](const std::string& file) -> std::string {
    try {
      LoadYaml(file);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("no/such.yaml"),
            "no/such.yaml: cannot be read: No such file or directory");
  EXPECT_EQ(refusal(folder), folder + ": cannot be read: Is a directory");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is not a regular file");
  const std::string pipe = folder + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), pipe + ": is not a regular file");
  const std::string large = folder + "/large.yaml";
  std::ofstream(large) << "a: " << Repeat("b", (1 << 20) + 1);
  EXPECT_EQ(refusal(large), large + ": is larger than 1 MiB, must be smaller");
}

TEST(Shown, DescribesEveryTypeOfValue) {
  const YAML::Node root = ParseYaml("a: {b: 1}\nc: [1]\nd: [~]\ne: x\n", "f");
  EXPECT_EQ(Shown(root["a"]), "a map");
  EXPECT_EQ(Shown(root["c"]), "the list '[1]'");
  EXPECT_EQ(Shown(root["d"]), "a list");
  EXPECT_EQ(Shown(ParseYaml("[1, 2, 3, 4, 5, 6, 7]", "f")), "a list");
  EXPECT_EQ(Shown(root["d"][0]), "empty");
  EXPECT_EQ(Shown(root["e"]), "'x'");
}

}  // namespace
}  // namespace poise
