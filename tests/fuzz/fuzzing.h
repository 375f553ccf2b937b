// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

/// What each fuzzer defines. Aborts where something is wrong with the code
/// under test, whatever the input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace poise {

/// A file in memory, for readers that take a path.
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

/// Calls a reader. It may refuse its input by std::invalid_argument with one
/// line that says something; aborts if it refuses in any other way.
void ExpectReadsOrRefuses(const std::function<void()>& read);

/// Aborts, and says what was to hold, if it does not.
void Require(bool holds, const char* what);

}  // namespace poise
