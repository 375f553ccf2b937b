// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import * as THREE from 'three';
import {convexHull, copOf} from './geometry.js';

/**
 * Returns the contacts with the ground at a time: each foot's force in the world
 * and its point of action, the support polygon, and the CoP of both feet. The
 * robot must already be in its pose of that time.
 */
export function contactsAt(run, robot, time) {
  const feet = robot.feet.map((foot) => {
    const value = (part) => run.motion.at(`${foot.name}.${part}`, time, 0);
    const wrench = {mx: value('mx'), my: value('my'), fz: value('fz')};
    const toWorld = foot.frame.matrixWorld;
    const cop = copOf(wrench);
    const point = cop &&
        new THREE.Vector3(cop[0], cop[1], 0).applyMatrix4(toWorld);
    const force = new THREE.Vector3(value('fx'), value('fy'), wrench.fz)
        .transformDirection(toWorld)
        .multiplyScalar(Math.hypot(value('fx'), value('fy'), wrench.fz));
    const sole = foot.polygon.map(([x, y]) => {
      const corner = new THREE.Vector3(x, y, 0).applyMatrix4(toWorld);
      return [corner.x, corner.y];
    });
    return {name: foot.name, meant: value('contact') > 0.5, load: wrench.fz,
            point, force, sole};
  });
  const loaded = feet.filter((foot) => foot.point);
  const load = loaded.reduce((sum, foot) => sum + foot.load, 0);
  const cop = load > 0 ? [0, 1].map((i) => loaded.reduce(
      (sum, foot) => sum + foot.point.getComponent(i) * foot.load, 0) / load) :
      null;
  const support = convexHull(
      feet.filter((foot) => foot.meant).flatMap((foot) => foot.sole));
  return {feet, cop, support};
}
