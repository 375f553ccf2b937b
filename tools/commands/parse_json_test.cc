// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/parse_json.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace poise {
namespace {

std::string Refusal(const std::string& text) {
  try {
    ParseJson(text);
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
  EXPECT_EQ(Refusal(Nested(102)), "is nested more than 100 levels deep");
  EXPECT_EQ(Refusal(Nested(1'000'000)), "is nested more than 100 levels deep");
  EXPECT_EQ(Refusal("{\"a\": " + Nested(200'000) + "}"),
            "is nested more than 100 levels deep");
}

TEST(ParseJson, RejectsDuplicateKeys) {
  EXPECT_EQ(Refusal(R"({"a": 1, "b": {"a": 2}, "c": [{"a": 3}, {"a": 4}]})"),
            "accepted");
  EXPECT_EQ(Refusal(R"({"a": 1, "b": {"a": 2}, "a": 3})"),
            "has the key \"a\" twice");
  EXPECT_EQ(Refusal(R"([{"b": {"a": 2, "c": [], "a": 3}}])"),
            "has the key \"a\" twice");
}

TEST(ParseJson, AcceptsOnlyJson) {
  EXPECT_EQ(ParseJson("{\"a\": [1, {\"b\": 2.5}]}")["a"][1]["b"], 2.5);
  EXPECT_EQ(Refusal("{\"a\": [1,}").find("not JSON: "), 0u);
  EXPECT_EQ(Refusal("").find("not JSON: "), 0u);
  EXPECT_EQ(Refusal(std::string("{}\0 and more", 12)),
            "not JSON: has a NUL character");
}

}  // namespace
}  // namespace poise
