// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <nlohmann/json.hpp>

#include "poise/sim/log/csv_reader.h"
#include "poise/tests/fuzz/fuzzing.h"
#include "poise/tools/commands/report/run_log.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const poise::MemoryFile file(data, size);
  poise::ExpectReadsOrRefuses([&] {
    poise::CsvReader reader(file.path());
    while (reader.Next()) {
      for (std::size_t i = 0; i < reader.columns().size(); ++i) {
        reader.Number(static_cast<int>(i));
      }
    }
  });
  // The report is written with this error handler, which accepts any bytes of a
  // log.
  poise::ExpectReadsOrRefuses([&] {
    (void)poise::ReadRunLog(file.path())
        .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  });
  poise::ExpectReadsOrRefuses(
      [&] { (void)poise::ReadTiming(file.path(), 1e-3).dump(); });
  return 0;
}
