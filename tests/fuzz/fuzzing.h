// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

/// Each fuzzer defines this function. It aborts if the code under test does
/// something wrong, for any input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace poise {

/// A file in memory, for readers that take a path. Aborts if it cannot be made.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const;

 private:
  int descriptor_;
};

/// Calls a reader, which may reject its input with std::invalid_argument. The
/// message must be one line and not empty. Aborts if the reader throws anything
/// else.
void ExpectReadsOrRefuses(const std::function<void()>& read);

/// If `holds` is false, prints `what`, the requirement, and aborts.
void Require(bool holds, const char* what);

}  // namespace poise
