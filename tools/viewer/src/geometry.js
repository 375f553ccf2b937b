// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

/** Returns the convex hull of [x, y] points, counterclockwise (Andrew's chain). */
export function convexHull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const turn = (o, a, b) =>
      (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (list) => {
    const hull = [];
    for (const point of list) {
      while (hull.length > 1 && turn(hull.at(-2), hull.at(-1), point) <= 0) {
        hull.pop();
      }
      hull.push(point);
    }
    hull.pop();
    return hull;
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

/** Returns a wrench's center of pressure in its frame; null if fz <= 1 N. */
export function copOf({mx, my, fz}) {
  return fz > 1 ? [-my / fz, mx / fz] : null;
}
