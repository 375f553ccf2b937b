// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/outcome.h"

#include <cstdio>

namespace poise {

std::string Outcome(const Verdict& verdict) {
  if (verdict.recovered) return "recovers";
  if (!verdict.fell_at) return "does not come back";
  char text[40];
  std::snprintf(text, sizeof(text), "falls at %.2f s", *verdict.fell_at);
  return text;
}

}  // namespace poise
