// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Runs as data: no drawing here, and no page. What draws asks a Run for values
// at a time; a live feed would be another class with the same face.
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

/** Named quantities over a rising time. Channels are decoded when asked for. */
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

  /** All values of a channel; undefined if there is no such channel. */
  values(name) {
    if (!this.#channels.has(name)) return undefined;
    if (!this.#decoded.has(name)) {
      this.#decoded.set(name, decodeChannel(this.#channels.get(name)));
    }
    return this.#decoded.get(name);
  }

  /** The last row at or before a time; 0 before the first. */
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

  /** Where a time lies: rows [i, j] and the part of the way between them. */
  between(time) {
    const i = this.row(time);
    const j = Math.min(i + 1, this.rows - 1);
    const span = this.time[j] - this.time[i];
    const part = span > 0 ? (time - this.time[i]) / span : 0;
    return {i, j, part: Math.min(1, Math.max(0, part))};
  }

  /** A channel at a time, linear between rows; `fallback` if there is none. */
  at(name, time, fallback = NaN) {
    const values = this.values(name);
    if (!values || values.length === 0) return fallback;
    const {i, j, part} = this.between(time);
    return values[i] + (values[j] - values[i]) * part;
  }
}

/** One run: what was recorded, and what was said about it. */
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

  /** The intervals in which somebody pushed: [[from, to], ...]. */
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

  /** A vector of channels PREFIXx, PREFIXy, PREFIXz at a time. */
  vector(prefix, time) {
    return ['x', 'y', 'z'].map(
        (axis) => this.motion.at(prefix + axis, time, 0));
  }

  /** The push at a time, N, not smoothed: a push has sharp ends. */
  push(time) {
    const row = this.signals.row(time);
    return ['x', 'y', 'z'].map(
        (axis) => this.signals.values(`push.f${axis}`)?.[row] ?? 0);
  }

  /**
   * The pushes that act at a time: [{force, frame, body, point}, ...], the force
   * in N along the axes of `frame`, 'world' or 'body'; the point in m along
   * those of the body.
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
   * The capture point's x and y: x + v / w, w the pendulum's frequency at the
   * present height. The velocity is that of the CoM over a few rows.
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

/** The runs in a page's block of data. */
export function readRuns(text) {
  const document = JSON.parse(text);
  if (document.format !== 'poise-report-1') {
    throw new Error(`This page was filled with "${document.format}" data.`);
  }
  return document.runs.map((run, i) => new Run(run, 'AB'[i]));
}
