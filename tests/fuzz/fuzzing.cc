// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/fuzz/fuzzing.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace poise {

MemoryFile::MemoryFile(const std::uint8_t* data, std::size_t size)
    : descriptor_(memfd_create("fuzz", 0)) {
  Require(descriptor_ >= 0, "a file in memory can be created");
  while (size > 0) {
    const ssize_t written = write(descriptor_, data, size);
    Require(written > 0, "a file in memory can be written");
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

MemoryFile::~MemoryFile() { close(descriptor_); }

std::filesystem::path MemoryFile::path() const {
  return "/proc/self/fd/" + std::to_string(descriptor_);
}

void ExpectReadsOrRefuses(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::invalid_argument& refusal) {
    const std::string_view message = refusal.what();
    Require(!message.empty(), "the error message is not empty");
    Require(message.find('\n') == message.npos,
            "the error message is one line");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "input rejected with: %s\n", error.what());
    Require(false, "input is rejected with std::invalid_argument");
  }
}

void Require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "requirement violated: %s\n", what);
  std::abort();
}

}  // namespace poise
