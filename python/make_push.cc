// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/python/make_push.h"

#include <stdexcept>
#include <string>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"

namespace poise {

Push MakePush(py::handle force, double start, py::handle duration,
              py::handle link, py::handle point, py::handle moment,
              py::handle profile) {
  Push push;
  push.force = AsVector3(force, "force");
  if (!moment.is_none()) push.moment = AsVector3(moment, "moment");
  if (!point.is_none()) push.point = AsVector3(point, "point");
  push.link = AsText(link, "link");
  push.start = start;
  push.duration = AsNumber(duration, "duration");
  const std::string name = AsText(profile, "profile");
  for (const PushProfile each :
       {PushProfile::kBox, PushProfile::kHalfSine, PushProfile::kImpulse}) {
    if (name != NameOf(each)) continue;
    push.profile = each;
    return push;
  }
  throw std::invalid_argument("profile is '" + name +
                              "', must be 'box', 'half_sine' or 'impulse'");
}

}  // namespace poise
