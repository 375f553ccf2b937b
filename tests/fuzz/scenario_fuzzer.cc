// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <cmath>

#include "poise/sim/scenario.h"
#include "poise/tests/fuzz/fuzzing.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using poise::Require;
  const poise::MemoryFile file(data, size);
  poise::ExpectReadsOrRefuses([&] {
    const poise::Scenario scenario = poise::LoadScenario(file.path());
    Require(std::isfinite(scenario.duration), "the duration is finite");
    Require(scenario.control.dt > 0 && scenario.plant.dt > 0,
            "time steps are positive");
    for (const poise::Push& push : scenario.pushes) {
      Require(push.force.allFinite() && push.moment.allFinite(),
              "a push is finite");
      Require(push.duration >= 0, "the duration of a push is not negative");
    }
    for (const poise::StanceEvent& event : scenario.stance) {
      Require(event.height > 0 && event.over > 0,
              "an event has a positive height and duration");
    }
  });
  poise::ExpectReadsOrRefuses([&] { poise::LoadPushes(file.path()); });
  return 0;
}
