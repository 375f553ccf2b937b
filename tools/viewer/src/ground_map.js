// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import {outlineAt} from './footprints.js';

const TRAIL = 0.5;  // Shown past of CoM and capture point, s.

// The map follows the feet when they are farther from its middle than this part
// of its width.
const FREE = 0.12;

/** Returns the middle and the larger side of the box around the soles. */
function boundsOf(feet) {
  const points = feet.flatMap((foot) => foot.sole);
  if (points.length === 0) return null;
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const ends = [xs, ys].map((all) => [Math.min(...all), Math.max(...all)]);
  return {middle: ends.map(([least, most]) => (least + most) / 2),
          size: Math.max(...ends.map(([least, most]) => most - least))};
}

/**
 * A map of the ground, with forward up. It shows the soles, the support polygon,
 * CoM, CoP and capture point on a small canvas over a stage. For a robot that
 * steps it also shows the footprints and the planned place of the foot in the
 * air.
 */
export class GroundMap {
  constructor(canvas, stage, palette) {
    this.canvas = canvas;
    this.stage = stage;
    this.palette = palette;
    this.center = null;
  }

  setPalette(palette) {
    this.palette = palette;
  }

  // Centers the map on the robot's first stance. It follows when the robot
  // walks away, and does not move when the robot only sways.
  #fit(contacts) {
    const bounds = boundsOf(contacts.feet);
    if (!bounds) return;
    const prints = this.stage.footprints.map(({outline}) => ({sole: outline}));
    if (prints.length) {
      const all = boundsOf(prints);
      this.center ??= all.middle;
      this.span ??= 1.25 * all.size;
      return;
    }
    this.span ??= 1.5 * Math.max(bounds.size, 0.05);
    this.center ??= bounds.middle;
    const free = FREE * this.span;
    this.center = this.center.map((at, axis) => Math.min(
        Math.max(at, bounds.middle[axis] - free), bounds.middle[axis] + free));
  }

  draw(time) {
    const {canvas, stage, palette} = this;
    const {contacts} = stage;
    const ratio = Math.min(2, window.devicePixelRatio);
    const size = canvas.clientWidth;
    if (!contacts || !size) return;
    this.#fit(contacts);
    if (!this.center) return;
    if (canvas.width !== Math.round(size * ratio)) {
      canvas.width = canvas.height = Math.round(size * ratio);
    }
    const context = canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, size, size);
    const scale = size / this.span;
    // Forward (+x) is up, left (+y) is left.
    const to = ([x, y]) => [size / 2 - (y - this.center[1]) * scale,
                            size / 2 - (x - this.center[0]) * scale];
    const path = (points, close) => {
      context.beginPath();
      points.map(to).forEach(([x, y], i) =>
        i ? context.lineTo(x, y) : context.moveTo(x, y));
      if (close) context.closePath();
    };
    context.strokeStyle = palette.ink;
    context.lineWidth = 1;
    context.globalAlpha = 0.3;
    for (const {outline, from} of stage.footprints) {
      if (from > time) continue;
      path(outline, true);
      context.stroke();
    }
    const plan = stage.run.plan(time);
    if (plan) {
      path(outlineAt(stage.soles.get(plan.foot) ?? [], plan.place), true);
      context.setLineDash([4, 3]);
      context.globalAlpha = 1;
      context.strokeStyle = palette.capture;
      context.stroke();
      context.setLineDash([]);
    }
    for (const foot of contacts.feet) {
      path(foot.sole, true);
      context.fillStyle = palette.ink;
      context.globalAlpha = foot.point ? 0.16 : 0.05;
      context.fill();
      context.globalAlpha = 0.35;
      context.strokeStyle = palette.ink;
      context.lineWidth = 1;
      context.stroke();
    }
    if (contacts.support.length > 2) {
      path(contacts.support, true);
      context.globalAlpha = 0.12;
      context.fillStyle = palette.support;
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 1.5;
      context.strokeStyle = palette.support;
      context.stroke();
    }
    const trail = (color, at) => {
      const points = [];
      for (let t = Math.max(stage.run.start, time - TRAIL); t < time; t += 0.01) {
        points.push(at(t));
      }
      if (points.length < 2) return;
      path(points, false);
      context.globalAlpha = 0.5;
      context.strokeStyle = color;
      context.lineWidth = 1.5;
      context.stroke();
    };
    trail(palette.capture, (t) => stage.run.capturePoint(t));
    trail(palette.com, (t) => stage.run.vector('com.', t));
    context.globalAlpha = 1;
    const spot = (point, color, draw) => {
      if (!point) return;
      const [x, y] = to(point);
      context.beginPath();
      draw(x, y);
      context.fillStyle = color;
      context.fill();
      context.lineWidth = 1.5;
      context.strokeStyle = palette.surface;
      context.stroke();
    };
    spot(contacts.capture, palette.capture, (x, y) => {
      context.moveTo(x, y - 6);
      context.lineTo(x + 6, y);
      context.lineTo(x, y + 6);
      context.lineTo(x - 6, y);
      context.closePath();
    });
    spot(contacts.com, palette.com, (x, y) => context.arc(x, y, 4.5, 0, 7));
    spot(contacts.cop, palette.cop, (x, y) => context.rect(x - 4, y - 4, 8, 8));
  }
}
