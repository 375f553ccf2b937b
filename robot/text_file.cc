// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/text_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "poise/robot/finding.h"

namespace poise {

std::string ReadTextFile(const std::filesystem::path& file, size_t most_mib) {
  const auto refuse = [&](const std::string& what) {
    throw Refusal(file.string(), 0, what);
  };
  const auto refuse_with_reason = [&](int reason) {
    refuse("cannot be read: " + std::generic_category().message(reason));
  };
  std::error_code error;
  const std::filesystem::file_status status =
      std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuse_with_reason(EISDIR);
  if (std::filesystem::exists(status) &&
      !std::filesystem::is_regular_file(status)) {
    refuse("is not a regular file");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse_with_reason(errno);
  std::string text;
  std::string chunk(size_t{1} << 20, '\0');
  while (stream.read(chunk.data(), chunk.size()), stream.gcount() > 0) {
    text.append(chunk, 0, stream.gcount());
    if (text.size() > most_mib << 20) {
      refuse("is larger than " + std::to_string(most_mib) +
             " MiB, must be smaller");
    }
  }
  if (!stream.eof()) refuse_with_reason(errno);
  return text;
}

void ExpectText(std::string_view text, const std::string& source) {
  if (text.find('\0') == std::string_view::npos) return;
  throw Refusal(source, 0, "is binary, must be UTF-8 text");
}

}  // namespace poise
