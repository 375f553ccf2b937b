// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/parse_json.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace poise {
namespace {

std::string Refusal(const std::string& text) {
  try {
    ParseJson(text, "a.json");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

std::string Nested(int depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(ParseJson, RejectsDeepNesting) {
  EXPECT_EQ(Refusal(Nested(100)), "accepted");
  EXPECT_EQ(Refusal(Nested(102)),
            "a.json: is nested more than 100 levels deep");
  EXPECT_EQ(Refusal(Nested(1'000'000)),
            "a.json: is nested more than 100 levels deep");
  EXPECT_EQ(Refusal("{\"a\": " + Nested(200'000) + "}"),
            "a.json: is nested more than 100 levels deep");
}

TEST(ParseJson, RejectsDuplicateKeys) {
  EXPECT_EQ(Refusal(R"({"a": 1, "b": {"a": 2}, "c": [{"a": 3}, {"a": 4}]})"),
            "accepted");
  EXPECT_EQ(Refusal(R"({"a": 1, "b": {"a": 2}, "a": 3})"),
            "a.json: has the key \"a\" twice");
  EXPECT_EQ(Refusal(R"([{"b": {"a": 2, "c": [], "a": 3}}])"),
            "a.json: has the key \"a\" twice");
}

TEST(ParseJson, AcceptsOnlyJson) {
  EXPECT_EQ(ParseJson("{\"a\": [1, {\"b\": 2.5}]}", "a.json")["a"][1]["b"],
            2.5);
  EXPECT_EQ(Refusal(std::string("{}\0 and more", 12)),
            "a.json:1:3: is not JSON: has a NUL character");
}

TEST(ParseJson, NamesLineAndColumnInPlainWords) {
  const std::string start = "is not JSON: ";
  for (const char* empty : {"", " \r\n\t"}) {
    EXPECT_EQ(Refusal(empty), "a.json: is empty, must be JSON");
  }
  EXPECT_EQ(Refusal("{\"a\": [1,}"), "a.json:1:10: " + start +
                                         "unexpected '}', must be '[', '{', "
                                         "or a literal");
  EXPECT_EQ(Refusal("[1]\n]"),
            "a.json:2:1: " + start + "unexpected ']', must be end of input");
  EXPECT_EQ(Refusal("[1,\n  nan]"),
            "a.json:2:4: " + start +
                "there is text that is neither quoted, nor a number, true, "
                "false or null");
  EXPECT_EQ(Refusal("{\n\"a\": 1"),
            "a.json:2:6: " + start + "the file ends too early");
  for (const char* cut : {"[1, tr", "[1, tr\n\n"}) {
    EXPECT_NE(Refusal(cut).find("the file ends too early"), std::string::npos);
  }
  EXPECT_EQ(Refusal("[1, trx").find("the file ends"), std::string::npos);
  EXPECT_EQ(Refusal("[\"a]"), "a.json:1:4: " + start +
                                  "a text has no closing quotation mark, or a "
                                  "character that JSON forbids");
  EXPECT_EQ(Refusal("[1.]"), "a.json:1:4: " + start + "a number is malformed");
  EXPECT_EQ(Refusal("[1,\n 1e400]"),
            "a.json:2:2: number is '1e400', which is too large");
}

TEST(ReadJsonOfRun, ReadsAnObjectOrSaysWhatToDo) {
  const auto read = [](const char* text) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "object.json";
    std::ofstream(file) << text;
    try {
      return ReadJsonOfRun(file, "run push again").dump();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(file.string().size());
    }
  };
  EXPECT_EQ(read("{\"a\": 1}"), "{\"a\":1}");
  EXPECT_EQ(read("[1]"), ": is [1], must be a JSON object; run push again");
  EXPECT_EQ(read("{\"a\": 1"),
            ":1:7: is not JSON: the file ends too early; run push again");
  EXPECT_EQ(read(""), ": is empty, must be JSON; run push again");
}

}  // namespace
}  // namespace poise
