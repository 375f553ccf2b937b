// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Prints the resident memory of one controller, in MB, for robots of 50 and of
// 120 joints.
//   bazel run --config=opt //tests/benchmarks:controller_memory
#include <sys/resource.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "poise/robot/control/controller.h"
#include "poise/tests/util/load_humanoid.h"
#include "poise/tests/util/random_biped.h"

namespace poise {
namespace {

constexpr double kKilobytesPerMegabyte = 1024;

// A biped has 13 joints, and the others in a chain on its trunk.
Robot MakeRobotOf120Joints() {
  BipedCase biped;
  for (int i = 0; i < 107; ++i)
    biped.chain.push_back(Eigen::Vector3d::Unit(i % 3));
  return MakeBiped(biped);
}

// Returns the largest resident memory of this process so far, in MB.
double ResidentMegabytes() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / kKilobytesPerMegabyte;
}

using Controllers = std::vector<std::unique_ptr<Controller>>;

// Adds `count` controllers of a robot, and prints the memory of each. The
// maximum of the resident memory grows only because no controller is deleted.
void Measure(const Robot& robot, int count, Controllers* controllers) {
  // The temporary memory of a constructor is reused by the next one.
  controllers->push_back(std::make_unique<Controller>(robot));
  const double before = ResidentMegabytes();
  for (int i = 0; i < count; ++i) {
    controllers->push_back(std::make_unique<Controller>(robot));
  }
  std::printf("%3d joints: %.2f MB per controller\n",
              robot.model.tree.num_joints(),
              (ResidentMegabytes() - before) / count);
}

}  // namespace
}  // namespace poise

int main() {
  poise::Controllers controllers;
  poise::Measure(poise::LoadHumanoid(), 100, &controllers);
  poise::Measure(poise::MakeRobotOf120Joints(), 20, &controllers);
}
