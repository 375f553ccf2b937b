// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

/**
 * Returns where the soles of the robot's feet stood, and where they step to:
 * [{foot, outline, from, planned}]. An outline has the corners of a sole, m.
 * `from` is the time from which the footprint exists, s. All are empty for a
 * run without steps.
 *
 * @param soles  the soles at the start of the run: Map of a foot's name to its
 *     corners.
 */
export function footprintsOf(run, soles) {
  const prints = [];
  if (!run.steps.length) return prints;
  for (const [foot, sole] of soles) {
    prints.push({foot, outline: sole, from: -Infinity});
  }
  for (const step of run.steps) {
    prints.push({foot: step.foot, from: step.at + step.swing_s,
                 outline: outlineAt(soles.get(step.foot) ?? [], step.landed)});
  }
  return prints;
}

/** Moves the corners of a sole, so that their middle is at a place. */
export function outlineAt(sole, place) {
  if (!sole.length) return [];
  const middle = [0, 1].map((axis) => {
    const all = sole.map((corner) => corner[axis]);
    return (Math.min(...all) + Math.max(...all)) / 2;
  });
  return sole.map((corner) => corner.map(
      (at, axis) => at - middle[axis] + place[axis]));
}
