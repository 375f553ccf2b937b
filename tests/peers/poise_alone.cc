// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Makes Poise's controller only, for a test of measure_controllers.
#include "poise/tests/peers/peer_controller.h"

namespace poise {

std::vector<std::unique_ptr<PeerController>> MakeControllers(
    const ControllerSetup& setup) {
  std::vector<std::unique_ptr<PeerController>> controllers;
  controllers.push_back(MakePoiseController(setup));
  return controllers;
}

}  // namespace poise
