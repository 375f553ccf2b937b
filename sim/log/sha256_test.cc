// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/sha256.h"

#include <gtest/gtest.h>

namespace poise {
namespace {

std::string DigestOf(std::string_view text) {
  Sha256 hash;
  hash.Update(text);
  return hash.Digest();
}

// The examples of FIPS 180-4.
TEST(Sha256, AgreesWithItsStandard) {
  EXPECT_EQ(DigestOf("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(
      DigestOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
      "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(DigestOf(""),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(DigestOf(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, ContinuesAfterADigest) {
  Sha256 hash;
  hash.Update("a");
  EXPECT_EQ(hash.Digest(), DigestOf("a"));
  hash.Update("bc");
  EXPECT_EQ(hash.Digest(), DigestOf("abc"));
  EXPECT_EQ(hash.Digest(), DigestOf("abc"));
}

TEST(Sha256, DigestDoesNotDependOnThePieces) {
  Sha256 hash;
  std::string text;
  for (int i = 0; i < 200; ++i) {
    const std::string piece(i, static_cast<char>('a' + i % 26));
    text += piece;
    hash.Update(piece);
  }
  EXPECT_EQ(hash.Digest(), DigestOf(text));
}

}  // namespace
}  // namespace poise
