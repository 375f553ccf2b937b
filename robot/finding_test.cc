// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/finding.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

TEST(IsUtf8, AcceptsOnlyCompleteCharacters) {
  for (const char* text : {"", "a", "\xc2\x80", "\xc3\xa9", "\xe6\x97\xa5",
                           "\xed\x9f\xbf", "\xf0\x9f\xa4\x96"}) {
    EXPECT_TRUE(IsUtf8(text)) << text;
  }
  // Invalid: a continuation byte alone, a truncated character, an encoding that
  // is too long, half of a surrogate pair, a code point above U+10FFFF.
  for (const char* text :
       {"\xe9", "caf\xe9 ", "\x80", "\xe6\x97", "\xc1\xbf", "\xe0\x9f\xbf",
        "\xf0\x8f\xbf\xbf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"}) {
    EXPECT_FALSE(IsUtf8(text)) << text;
  }
}

TEST(OneLine, KeepsPrintableAndBlanksControlCharacters) {
  EXPECT_EQ(OneLine("l\xc3\xa9g \xe6\x97\xa5"), "l\xc3\xa9g \xe6\x97\xa5");
  EXPECT_EQ(OneLine("a\nb\tc\x1b[31m\x7f"), "a b c [31m ");
  EXPECT_EQ(OneLine("a\xc2\x9b"
                    "31m"),
            "a 31m");  // C1 control.
  EXPECT_EQ(OneLine("a\xe2\x80\xa8"
                    "b\xe2\x80\xae"
                    "c"),
            "a b c");  // Line end, bidi.
  EXPECT_EQ(OneLine("a\xe2\x81\xa6"
                    "b\xef\xbb\xbf"
                    "c"),
            "a b c");
  EXPECT_EQ(OneLine("caf\xe9!"), "caf?!");
}

TEST(Quoted, CutsBetweenCharacters) {
  EXPECT_EQ(Quoted("a\nb"), "'a b'");
  const std::string sixty(60, 'n');
  EXPECT_EQ(Quoted(sixty), "'" + sixty + "'");
  EXPECT_EQ(Quoted(sixty + "n"), "'" + sixty + "...'");
  const std::string before(59, 'n');
  EXPECT_EQ(Quoted(before + "\xc3\xa9" + "x"), "'" + before + "...'");
}

TEST(Refusal, IsOneLineWithFileAndLine) {
  const Refusal refusal("a\nb.urdf", 3, "is odd");
  EXPECT_EQ(std::string(refusal.what()), "a b.urdf:3: is odd");
  EXPECT_EQ(refusal.finding().line, 3);
  EXPECT_EQ(std::string(Refusal("f", 0, "is odd").what()), "f: is odd");
  const Finding finding{Severity::kReject, "link 'a'", "is odd", "must not", 2};
  EXPECT_EQ(Message("f", finding), "f:2: link 'a': is odd, must not");
}

}  // namespace
}  // namespace poise
