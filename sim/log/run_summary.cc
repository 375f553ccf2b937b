// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_summary.h"

#include <fstream>
#include <string_view>
#include <vector>

#include "poise/sim/log/open_log.h"
#include "poise/sim/log/sha256.h"

namespace poise {
namespace {

std::string HashOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> block(1 << 20);
  Sha256 hash;
  do {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.Update({block.data(), static_cast<std::size_t>(stream.gcount())});
  } while (stream);
  return hash.Digest();
}

}  // namespace

RunSummary ReadRunSummary(const std::filesystem::path& run) {
  std::ifstream stream(run / "summary.json");
  if (!stream) return {nullptr, "summary.json does not exist."};
  nlohmann::json values = nlohmann::json::parse(stream, nullptr,
                                                /*allow_exceptions=*/false);
  if (!values.is_object()) {
    return {nullptr, "summary.json cannot be read as JSON."};
  }
  const std::filesystem::path log = FindLog(run);
  const auto hash = values.find("log_sha256");
  if (hash != values.end() && *hash != HashOf(log)) {
    return {nullptr,
            "summary.json does not belong to this " + log.filename().string() +
                ": its log_sha256 differs. The log is of another run, or was "
                "cut short or changed.",
            true};
  }
  return {std::move(values), ""};
}

}  // namespace poise
