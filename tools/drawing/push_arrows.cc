// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/push_arrows.h"

#include <Eigen/Core>
#include <string>

#include "poise/sim/push.h"

namespace poise {
namespace {

using nlohmann::json;

Eigen::Vector3d ReadVector(const json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(),
          numbers.at(2).get<double>()};
}

PushProfile ReadProfile(const json& entry) {
  const auto name = entry.at("shape").get<std::string>();
  for (const PushProfile profile :
       {PushProfile::kHalfSine, PushProfile::kImpulse}) {
    if (name == NameOf(profile)) return profile;
  }
  return PushProfile::kBox;
}

}  // namespace

std::vector<PushArrow> FindPushArrows(const json& summary, double time,
                                      const std::vector<Pose>& X_WB) {
  const double dt = summary.value("control_dt", 1e-3);
  std::vector<PushArrow> arrows;
  for (const json& entry : summary.value("pushes", json::array())) {
    Push push;
    push.profile = ReadProfile(entry);
    push.start = entry.at("at").get<double>();
    push.duration = entry.at("duration").get<double>();
    const Pose& X_WBody = X_WB.at(entry.at("body").get<std::size_t>());
    Eigen::Vector3d force =
        MeanOfProfile(push, time, dt) * ReadVector(entry.at("force"));
    if (force.isZero()) continue;
    if (entry.at("frame") == "body") force = X_WBody.R * force;
    arrows.push_back({X_WBody * ReadVector(entry.at("point")), force});
  }
  return arrows;
}

}  // namespace poise
