// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Runs a fuzzer without libFuzzer on the given files. Each file is tried
// intact, truncated, with a changed byte and with a removed byte.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "poise/tests/fuzz/fuzzing.h"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kSlips = 40;  // Faults of each kind, spread over a file.

void Run(const Bytes& bytes) {
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream stream(argv[i], std::ios::binary);
    if (!stream) {
      std::fprintf(stderr, "%s: cannot be read\n", argv[i]);
      return 1;
    }
    const Bytes bytes(std::istreambuf_iterator<char>(stream), {});
    Run(bytes);
    const std::size_t step = bytes.size() / kSlips + 1;
    for (std::size_t at = 0; at < bytes.size(); at += step) {
      Run(Bytes(bytes.begin(), bytes.begin() + at));
      Bytes changed = bytes;
      changed[at] ^= 0x11;
      Run(changed);
      changed.erase(changed.begin() + at);
      Run(changed);
    }
  }
  std::printf("%d seeds tried, each intact and corrupted\n", argc - 1);
  return argc > 1 ? 0 : 1;
}
