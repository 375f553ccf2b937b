// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import {escapeHtml, formatNumber} from './format.js';

// Height of a row, and position and height of its bar, in CSS pixels. On a
// narrow page the name is above the bar, see style.css.
const BESIDE = {row: 18, bar: 3, height: 12};
const ABOVE = {row: 30, bar: 16, height: 9};
const narrow = window.matchMedia('(max-width: 720px)');

/**
 * Rows of bars over time, each with a name, on a canvas that is aligned with the
 * plots. `spec` is {title, hint, rows: [{name, draw(context, toX, y, height)}],
 * few, onPick, empty}.
 */
export class Strip {
  #cursor;
  #all = false;

  constructor(parent, spec, {palette, xRange, onSeek}) {
    this.spec = spec;
    this.palette = palette;
    this.xRange = xRange;
    this.onSeek = onSeek;
    this.element = document.createElement('section');
    this.element.className = 'plot strip';
    this.element.innerHTML = `
      <header><h3>${spec.title}</h3><p class="hint"></p></header>
      <div class="rows"><ol></ol><div class="lane"><canvas></canvas>
      <div class="time-cursor"></div></div></div>
      <button class="more" hidden></button>`;
    this.element.querySelector('.hint').textContent = spec.hint ?? '';
    this.canvas = this.element.querySelector('canvas');
    this.lane = this.element.querySelector('.lane');
    this.#cursor = this.element.querySelector('.time-cursor');
    this.more = this.element.querySelector('.more');
    this.more.addEventListener('click', () => {
      this.#all = !this.#all;
      this.#build();
    });
    parent.append(this.element);
    this.#listen();
    this.#build();
    new ResizeObserver(() => this.draw()).observe(this.lane);
  }

  get #shown() {
    return this.#all ? this.spec.rows : this.spec.rows.slice(0, this.spec.few);
  }

  #build() {
    const {spec} = this;
    const list = this.element.querySelector('ol');
    list.innerHTML = this.#shown.map((row) =>
      `<li title="${escapeHtml(row.name)}">${escapeHtml(row.label ?? row.name)}</li>`)
        .join('');
    if (spec.onPick) {
      [...list.children].forEach((item, i) => {
        item.classList.add('pick');
        item.addEventListener('click', () => spec.onPick(this.#shown[i].name));
      });
    }
    if (spec.rows.length === 0) list.innerHTML = `<li class="none">${spec.empty}</li>`;
    this.more.hidden = spec.rows.length <= spec.few;
    this.more.textContent =
        this.#all ? 'Show fewer' : `Show all ${spec.rows.length}`;
    this.draw();
  }

  #listen() {
    const seek = (event) => {
      const box = this.lane.getBoundingClientRect();
      const [from, to] = this.xRange();
      this.onSeek(from + (event.clientX - box.left) / box.width * (to - from));
    };
    this.lane.style.touchAction = 'pan-y';
    this.lane.addEventListener('pointerdown', (event) => {
      this.lane.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.lane.addEventListener('pointermove', (event) => {
      if (this.lane.hasPointerCapture(event.pointerId)) seek(event);
    });
  }

  setPalette(palette) {
    this.palette = palette;
    this.draw();
  }

  rescale() {
    this.draw();
  }

  draw() {
    const width = this.lane.clientWidth;
    const at = narrow.matches ? ABOVE : BESIDE;
    const height = Math.max(1, this.#shown.length) * at.row;
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.height = `${height}px`;
    const context = this.canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [from, to] = this.xRange();
    const toX = (time) => (time - from) / (to - from || 1) * width;
    this.#shown.forEach((row, i) => {
      context.globalAlpha = 1;
      context.fillStyle = this.palette.line;
      const top = i * at.row + at.bar;
      context.fillRect(0, top + Math.floor(at.height / 2), width, 1);
      row.draw(context, toX, top, at.height, this.palette);
    });
    if (this.time !== undefined) this.update(this.time);
  }

  update(time) {
    this.time = time;
    const [from, to] = this.xRange();
    const x = (time - from) / (to - from || 1) * this.lane.clientWidth;
    this.#cursor.style.display =
        x >= -1 && x <= this.lane.clientWidth + 1 ? '' : 'none';
    this.#cursor.style.transform = `translateX(${x}px)`;
  }
}

/** Returns the palette color of a row of the hierarchy, by the row's name. */
export function kindOf(name) {
  if (/(^|\.)(cop|zmp|zmp_literal)\./.test(name)) return 'cop';
  if (/(^|\.)yaw(_constant)?(\.|$)/.test(name)) return 'c4';
  if (/friction|unilateral/.test(name)) return 'force';
  if (/torque/.test(name)) return 'push';
  if (/joint_limit/.test(name)) return 'capture';
  return 'c1';
}

/** Rows of a strip: the active constraints, darker for larger multipliers. */
export function activeRows(run) {
  return run.active.map(({name, peak, spans}) => ({
    name,
    draw(context, toX, y, height, palette) {
      context.fillStyle = palette[kindOf(name)];
      for (const [from, to, multiplier] of spans) {
        const left = toX(from);
        context.globalAlpha =
            0.35 + 0.65 * Math.sqrt(Math.abs(multiplier) / (peak || 1));
        context.fillRect(left, y, Math.max(1.5, toX(to) - left), height);
      }
    },
  }));
}

// Draws a channel as a bar. Each pixel is as dark as its largest value, 0 to 1.
function drawIntensity(context, toX, y, height, table, channel, of, colorOf) {
  const values = table.values(channel);
  const {time} = table;
  const width = context.canvas.width;
  let at = -1;
  let most = 0;
  const paint = (pixel) => {
    if (pixel < 0 || pixel > width || !(most > 0)) return;
    context.fillStyle = colorOf(most);
    context.globalAlpha = Math.min(1, most);
    context.fillRect(pixel, y, 1.2, height);
  };
  for (let i = 0; i < time.length; ++i) {
    const x = Math.floor(toX(time[i]));
    if (x !== at) {
      paint(at);
      // A pixel without a row has the color of the last pixel with one.
      for (let gap = Math.max(0, at + 1); at >= 0 && gap < Math.min(x, width);
        ++gap) {
        paint(gap);
      }
      at = x;
      most = 0;
    }
    most = Math.max(most, of(values[i]) || 0);
  }
  paint(at);
}

/**
 * Rows of a strip: the residual of each task, relative to its largest value.
 * Tasks without residual are left out.
 */
export function residualRows(run) {
  const rows = [];
  for (const channel of run.signals.names) {
    if (!channel.startsWith('residual.')) continue;
    const [low, high] = run.signals.range(channel);
    const peak = Math.max(-low, high);
    if (!(peak > 1e-6)) continue;
    const name = channel.slice('residual.'.length);
    rows.push({
      name, peak, label: `${name} ${formatNumber(peak)}`,
      draw: (context, toX, y, height, palette) => drawIntensity(
          context, toX, y, height, run.signals, channel,
          (value) => Math.sqrt(Math.abs(value) / peak), () => palette.c4),
    });
  }
  return rows;
}

/** Rows of a strip: the torque of each joint, relative to its limit. */
export function torqueRows(run) {
  const limits = run.robot?.limits ?? {};
  const rows = [];
  for (const channel of run.torques.names) {
    const joint = channel.slice('tau.'.length);
    const effort = limits[joint]?.effort;
    if (!effort) continue;
    const [low, high] = run.torques.range(channel);
    rows.push({name: joint, channel, effort,
               peak: Math.max(-low, high) / effort});
  }
  rows.sort((a, b) => b.peak - a.peak);
  for (const row of rows) {
    row.label = `${row.name} ${Math.round(100 * row.peak)} %`;
    row.draw = (context, toX, y, height, palette) => drawIntensity(
        context, toX, y, height, run.torques, row.channel,
        (value) => Math.abs(value) / row.effort,
        (use) => palette[use > 0.995 ? 'push' : 'c1']);
  }
  return rows;
}

// Returns the rows of a strip from [[name, from, to], ...], in palette colors.
function spanRows(list, colorOf) {
  const byName = new Map();
  for (const [name, from, to] of list) {
    if (!byName.has(name)) byName.set(name, []);
    byName.get(name).push([from, to]);
  }
  return [...byName].map(([name, spans]) => ({
    name,
    draw(context, toX, y, height, palette) {
      context.fillStyle = palette[colorOf(name)];
      for (const [from, to] of spans) {
        context.fillRect(toX(from), y, Math.max(1.5, toX(to) - toX(from)),
                         height);
      }
    },
  }));
}

/** Rows of a strip: when the controller's status was not "ok". */
export function statusRows(run) {
  return spanRows(run.status,
                  (name) => (name === 'fail_safe' ? 'push' : 'capture'));
}

/** Rows of a strip: when two links touched each other. */
export function touchingRows(run) {
  return spanRows(
      run.touching.map(([pair, ...span]) => [pair.replace('|', ' on '), ...span]),
      () => 'c3');
}
