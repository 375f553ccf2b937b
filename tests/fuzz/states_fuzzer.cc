// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <nlohmann/json.hpp>

#include "poise/dynamics/tree.h"
#include "poise/tests/fuzz/fuzzing.h"
#include "poise/tools/commands/dynamics/dynamics_file.h"
#include "poise/tools/commands/dynamics/dynamics_table.h"

namespace {

// A base with an arm of one hinge and one slide, with the joint names of the
// seed.
poise::Tree MakeArm() {
  poise::Inertia M;
  M.mass = 2;
  M.p_BoG_B = {0.1, -0.2, 0.3};
  M.I_G_B.diagonal() << 0.1, 0.2, 0.15;
  poise::JointSpec hinge, slide;
  hinge.name = "hinge";
  hinge.type = poise::JointType::kRevolute;
  hinge.parent = "base";
  hinge.child = "arm";
  hinge.X_PF.p = {0, 0.3, 0.1};
  slide.name = "slide";
  slide.type = poise::JointType::kPrismatic;
  slide.parent = "arm";
  slide.child = "hand";
  slide.axis_F = {0, 0.6, 0.8};
  return poise::TreeBuilder()
      .AddLink("base", M)
      .AddLink("arm", M)
      .AddLink("hand", M)
      .AddJoint(hinge)
      .AddJoint(slide)
      .Build();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using nlohmann::json;
  static const poise::Tree tree = MakeArm();
  const json document = json::parse(data, data + size, nullptr, false);
  if (document.is_discarded()) return 0;
  poise::ExpectReadsOrRefuses([&] {
    const json result = poise::ComputeDynamics(tree, document, {});
    poise::Require(result["states"].size() == document["states"].size(),
                   "the result has one entry per state");
    poise::Require(!poise::FormatDynamics(tree, result).empty(),
                   "the tables are not empty");
    (void)result.dump(-1, ' ', false, json::error_handler_t::replace);
  });
  return 0;
}
