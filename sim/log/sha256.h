// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace poise {

/// SHA-256 of a stream of bytes.
/// Source: FIPS 180-4, sections 4.1.2, 4.2.2, 5.1.1 and 6.2.2.
class Sha256 {
 public:
  void Update(std::string_view bytes);

  /// The digest of all bytes so far, in 64 hexadecimal digits.
  std::string Digest() const;

 private:
  void Absorb(const unsigned char* block);

  std::array<std::uint32_t, 8> hash_{0x6a09e667, 0xbb67ae85, 0x3c6ef372,
                                     0xa54ff53a, 0x510e527f, 0x9b05688c,
                                     0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::uint64_t length_ = 0;  // Bytes.
};

}  // namespace poise
