// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Needs all that the highest layer needs: headers of Bullet, and all libraries.
#include "poise/sim/plants/bullet/bullet_world.h"
#include "poise/sim/scenario.h"

int main() { return poise::Scenario().pushes.empty() ? 0 : 1; }
