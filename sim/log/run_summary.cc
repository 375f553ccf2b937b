// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/run_summary.h"

#include <fstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/sim/log/open_log.h"
#include "poise/sim/log/parse_json.h"
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

constexpr const char* kRemedy =
    "run push again, or remove this file to read the log alone";

[[noreturn]] void Refuse(const std::filesystem::path& file,
                         const std::string& defect) {
  throw std::invalid_argument(file.string() + ": " + defect + "; " + kRemedy);
}

// Checks the values from which a reader computes times, or says the outcome.
void RequireValid(const nlohmann::json& values,
                  const std::filesystem::path& file) {
  const auto refuse = [&](const char* key, const char* wanted) {
    Refuse(file, std::string(key) + " is " + OneLine(values[key].dump()) +
                     ", must be " + wanted);
  };
  if (!values.contains("recovered")) {
    Refuse(file, "has no key 'recovered', is not the summary of a run");
  }
  if (!values["recovered"].is_boolean() && !values["recovered"].is_null()) {
    refuse("recovered", "true, false or null");
  }
  const auto is_bad = [&](const char* key, auto is_good) {
    const nlohmann::json value = values.value(key, nlohmann::json());
    return !value.is_null() &&
           !(value.is_number() && is_good(value.get<double>()));
  };
  if (is_bad("control_dt", [](double dt) { return dt > 0; })) {
    refuse("control_dt", "a positive time, s");
  }
  for (const char* key : {"duration", "fell_at"}) {
    if (is_bad(key, [](double time) { return time >= 0; })) {
      refuse(key, "a time of at least 0 s");
    }
  }
}

}  // namespace

RunSummary ReadRunSummary(const std::filesystem::path& run) {
  const std::filesystem::path file = run / "summary.json";
  if (!std::filesystem::exists(file)) {
    return {nullptr, "summary.json does not exist."};
  }
  nlohmann::json values = ReadJsonOfRun(file, kRemedy);
  RequireValid(values, file);
  const std::filesystem::path log = FindLog(run);
  const auto hash = values.find("log_sha256");
  if (hash != values.end() && *hash != HashOf(log)) {
    return {nullptr,
            "summary.json does not belong to this " + log.filename().string() +
                ": its log_sha256 differs. The log is of another run, or was "
                "cut short or changed."};
  }
  return {std::move(values), ""};
}

}  // namespace poise
