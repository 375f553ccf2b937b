// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// The adapter of Poise's own controller, with its default options.
#include <stdexcept>
#include <string>

#include "poise/robot/control/controller.h"
#include "poise/tests/peers/peer_controller.h"

namespace poise {
namespace {

class PoiseController final : public PeerController {
 public:
  explicit PoiseController(const ControllerSetup& setup)
      : controller_(setup.robot), state_(setup.start) {
    for (const char* task : {"torque_limits", "joint_limits"}) {
      if (!controller_.stack().Enable(task, setup.has_limits)) {
        throw std::invalid_argument(std::string("no task ") + task);
      }
    }
    command_.tau.setZero(setup.robot.model.tree.num_joints());
    controller_.Start(setup.start);
  }

  const char* name() const override { return "Poise"; }

  void Load(const State& state) override { state_ = state; }

  bool Update() override {
    controller_.Update(state_, &command_);
    return command_.status == TickStatus::kOk ||
           command_.status == TickStatus::kLimitRelaxed;
  }

  // The torque is clamped to the effort limits, so it is not compared.
  ControllerAnswer answer() override { return {controller_.report().y, {}}; }

 private:
  Controller controller_;
  State state_;
  Command command_;
};

}  // namespace

std::unique_ptr<PeerController> MakePoiseController(
    const ControllerSetup& setup) {
  return std::make_unique<PoiseController>(setup);
}

}  // namespace poise
