// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The data of runs, without drawing. The views ask a Run for values at a time. A
// live feed would be another class with the same methods.
import {forceAt} from './pushes.js';

const NO_NUMBER = 65535;
const STEPS = 65534;

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new DataView(bytes.buffer);
}

/** The inverse of EncodeChannel() in tools/commands/report/channel.cc. */
export function decodeChannel({min, max, data}) {
  const bytes = bytesOf(data);
  const values = new Float32Array(bytes.byteLength / 2);
  for (let i = 0; i < values.length; ++i) {
    const u = bytes.getUint16(2 * i, true);
    values[i] = u === NO_NUMBER ? NaN : min + (max - min) * u / STEPS;
  }
  return values;
}

/** The inverse of EncodeFloats() in tools/commands/report/channel.cc. */
export function decodeFloats(data) {
  const bytes = bytesOf(data);
  const values = new Float32Array(bytes.byteLength / 4);
  for (let i = 0; i < values.length; ++i) {
    values[i] = bytes.getFloat32(4 * i, true);
  }
  return values;
}

/** Named channels over increasing time. A channel is decoded at its first use. */
export class Table {
  #channels = new Map();
  #decoded = new Map();

  constructor(table) {
    this.time = table ? decodeFloats(table.time) : new Float32Array(0);
    for (const channel of table ? table.channels : []) {
      this.#channels.set(channel.name, channel);
    }
  }

  get rows() {
    return this.time.length;
  }

  get names() {
    return [...this.#channels.keys()];
  }

  has(name) {
    return this.#channels.has(name);
  }

  range(name) {
    const {min, max} = this.#channels.get(name);
    return [min, max];
  }

  /** Returns all values of a channel, or undefined if it does not exist. */
  values(name) {
    if (!this.#channels.has(name)) return undefined;
    if (!this.#decoded.has(name)) {
      this.#decoded.set(name, decodeChannel(this.#channels.get(name)));
    }
    return this.#decoded.get(name);
  }

  /** Returns the last row at or before a time; 0 before the first row. */
  row(time) {
    let low = 0;
    let high = this.time.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.time[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** Returns the rows i, j around a time and its fraction between them. */
  between(time) {
    const i = this.row(time);
    const j = Math.min(i + 1, this.rows - 1);
    const span = this.time[j] - this.time[i];
    const part = span > 0 ? (time - this.time[i]) / span : 0;
    return {i, j, part: Math.min(1, Math.max(0, part))};
  }

  /** Returns a channel at a time, interpolated; `fallback` without values. */
  at(name, time, fallback = NaN) {
    const values = this.values(name);
    if (!values || values.length === 0) return fallback;
    const {i, j, part} = this.between(time);
    return values[i] + (values[j] - values[i]) * part;
  }
}

/** One run: its log, its summary, its robot, and notes about them. */
export class Run {
  constructor(document, label) {
    this.label = label;
    this.name = document.name;
    this.summary = document.summary ?? {};
    this.robot = document.robot;
    this.notes = document.notes ?? [];
    this.rows = document.log.rows;
    this.motion = new Table(document.log.motion);
    this.signals = new Table(document.log.signals);
    this.torques = new Table(document.log.torques);
    this.timing = new Table(document.timing);
    this.active = document.log.active ?? [];
    this.status = document.log.status ?? [];
    this.touching = document.log.touching ?? [];
  }

  get start() {
    return this.motion.rows ? this.motion.time[0] : 0;
  }

  get end() {
    const tables = [this.motion, this.signals].filter((table) => table.rows);
    return Math.max(0, ...tables.map((table) => table.time[table.rows - 1]));
  }

  /** The time intervals of pushes: [[from, to], ...]. */
  get pushes() {
    const axes = ['x', 'y', 'z'].map((a) => this.signals.values(`push.f${a}`));
    if (axes.some((axis) => !axis)) return [];
    const {time} = this.signals;
    const pushes = [];
    let from = null;
    for (let i = 0; i < time.length; ++i) {
      const pushed = axes.some((axis) => axis[i] !== 0);
      if (pushed && from === null) from = time[i];
      if (!pushed && from !== null) {
        pushes.push([from, time[i]]);
        from = null;
      }
    }
    if (from !== null) pushes.push([from, time[time.length - 1]]);
    return pushes;
  }

  /** The steps that the robot took and that have landed, in order of time. */
  get steps() {
    return (this.summary.steps ?? []).filter((step) => step.landed);
  }

  /** Returns the foot in the air and its planned place: {foot, place}, or null. */
  plan(time) {
    const row = this.motion.row(time);
    const place = ['x', 'y'].map(
        (axis) => this.motion.values(`plan.${axis}`)?.[row] ?? NaN);
    const step = (this.summary.steps ?? []).findLast(({at}) => at <= time);
    return step && place.every(Number.isFinite) ? {foot: step.foot, place} :
        null;
  }

  /** Returns the path of a foot's sole over a step: [[x, y, z], ...]. */
  swingPath({foot, at, swing_s: swing}) {
    const points = [];
    for (let t = at; t < at + swing + 0.005; t += 0.01) {
      const time = Math.min(t, at + swing);
      points.push(['x', 'y', 'z'].map(
          (axis) => this.motion.at(`${foot}.${axis}`, time)));
    }
    return points.every((point) => point.every(Number.isFinite)) ? points : [];
  }

  /** Returns the channels PREFIXx, PREFIXy, PREFIXz at a time as a vector. */
  vector(prefix, time) {
    return ['x', 'y', 'z'].map(
        (axis) => this.motion.at(prefix + axis, time, 0));
  }

  /** Returns the push at a time, N. Not interpolated: a push starts abruptly. */
  push(time) {
    const row = this.signals.row(time);
    return ['x', 'y', 'z'].map(
        (axis) => this.signals.values(`push.f${axis}`)?.[row] ?? 0);
  }

  /**
   * Returns the pushes that act at a time: [{force, frame, body, point}, ...].
   * The force [N] is in the axes of `frame`, 'world' or 'body'; the point [m] is
   * in the axes of the body.
   */
  pushesAt(time) {
    const {pushes, control_dt: dt = 1e-3, push_body: body,
      push_point: point} = this.summary;
    const now = Math.min(time, this.end);
    const all = pushes ?
        pushes.map((push) => ({...push, force: forceAt(push, now, dt)})) :
        [{force: this.push(now), frame: 'world', body, point}];
    return all.filter(({force}) => Math.hypot(...force) > 0);
  }

  /**
   * Returns x and y of the capture point x + v / w. w is the frequency of the
   * inverted pendulum at the present height. v is the velocity of the CoM, from
   * differences over 20 ms.
   */
  capturePoint(time) {
    const com = this.vector('com.', time);
    const step = 0.01;
    const ahead = this.vector('com.', Math.min(this.end, time + step));
    const behind = this.vector('com.', Math.max(this.start, time - step));
    const dt = Math.min(this.end, time + step) -
        Math.max(this.start, time - step);
    const pendulum = Math.sqrt(Math.max(0.05, com[2]) / 9.81);
    if (!(dt > 0)) return [com[0], com[1]];
    return [0, 1].map(
        (i) => com[i] + (ahead[i] - behind[i]) / dt * pendulum);
  }
}

/** Returns the runs in the data block of a page. */
export function readRuns(text) {
  const document = JSON.parse(text);
  if (document.format !== 'poise-report-1') {
    throw new Error('The data of this page has the format ' +
        `"${document.format}", but must have "poise-report-1".`);
  }
  return document.runs.map((run, i) => new Run(run, 'AB'[i]));
}
