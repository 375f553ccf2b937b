// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/test_file.h"

#include <cstdlib>
#include <fstream>

namespace poise {

std::filesystem::path TestFile(const std::string& name,
                               const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(std::getenv("TEST_TMPDIR")) / name;
  std::ofstream(file) << text;
  return file;
}

}  // namespace poise
