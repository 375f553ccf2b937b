// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/shell_word.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(ShellWord, IsOneWord) {
  EXPECT_EQ(ShellWord("../a_b-1.urdf"), "../a_b-1.urdf");
  EXPECT_EQ(ShellWord("my robot"), "'my robot'");
  EXPECT_EQ(ShellWord("$HOME*"), "'$HOME*'");
  EXPECT_EQ(ShellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(ShellWord(""), "''");
}

}  // namespace
}  // namespace poise
