// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import uPlot from 'uplot';
import {formatNumber} from './format.js';

/** Joins the series of runs on common times: [times, values, values, ...]. */
function joinedData(series) {
  const tables = series.map(({time, values}) => [time, values]);
  const same = tables.every(([time]) => time === tables[0][0]);
  if (same) return [tables[0][0], ...tables.map(([, values]) => values)];
  return uPlot.join(tables);
}

// Replaces NaN by null, for which uPlot leaves a gap in the line.
function withGaps(values) {
  return values.some(Number.isNaN) ?
    Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values;
}

/**
 * A plot over time: a label column with live values, and a uPlot. `spec` is
 * {title, unit, hint, scale, lines: [{name, color, dash, time, values}], marks:
 * [{value, name}], floor}.
 */
export class Plot {
  #cursor;

  constructor(parent, spec, {palette, xRange, onSeek, bands}) {
    this.spec = spec;
    this.palette = palette;
    this.xRange = xRange;
    this.onSeek = onSeek;
    this.bands = bands;
    this.element = document.createElement('section');
    this.element.className = 'plot';
    this.element.innerHTML = `
      <header><h3></h3><p class="hint"></p><ul class="legend"></ul></header>
      <div class="canvas"></div>`;
    this.#label();
    if (spec.control) this.element.querySelector('h3').after(spec.control);
    this.holder = this.element.querySelector('.canvas');
    parent.append(this.element);
    this.#build();
    new ResizeObserver(() => this.#resize()).observe(this.holder);
  }

  /** Shows other lines, and what belongs to them: `part` is a part of a spec. */
  change(part) {
    Object.assign(this.spec, part);
    this.#label();
    this.#build();
  }

  #label() {
    const {title, unit, hint = ''} = this.spec;
    this.element.querySelector('h3').innerHTML =
        `${title} <span class="unit">${unit}</span>`;
    this.element.querySelector('.hint').textContent = hint;
  }

  setPalette(palette) {
    this.palette = palette;
    this.#build();
  }

  #color(name) {
    return this.palette[name] ?? name;
  }

  // Returns the range of the y axis. It contains the lines, and the marks that
  // are close to a line.
  #yRange(low, high) {
    const {marks = [], floor, least = 0} = this.spec;
    if (low === null || !Number.isFinite(low)) return [-1, 1];
    if (floor !== undefined) low = Math.min(low, floor);
    for (const {value, always} of marks) {
      const span = Math.max(high - low, least);
      if (always || (value < high + 0.35 * span && value > low - 0.35 * span)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    const missing = Math.max(0, least - (high - low)) / 2;
    const margin = 0.07 * Math.max(high - low, 1e-9) + missing;
    return [floor !== undefined && low >= floor ? floor : low - margin,
            high + margin];
  }

  #build() {
    this.plot?.destroy();
    const {spec, palette} = this;
    const scale = spec.scale ?? 1;
    const shown = spec.lines.map((line) => ({
      ...line,
      values: withGaps(
          scale === 1 ? line.values : line.values.map((v) => v * scale)),
    }));
    this.data = shown.length ? joinedData(shown) : [new Float32Array(0)];
    const axis = {
      stroke: palette.faint,
      font: '11px system-ui, sans-serif',
      grid: {stroke: palette.line, width: 1},
      ticks: {show: false},
    };
    this.plot = new uPlot({
      width: Math.max(100, this.holder.clientWidth),
      height: spec.height ?? 132,
      legend: {show: false},
      cursor: {show: false},
      padding: [8, 16, 0, 0],
      scales: {
        x: {time: false, range: () => this.xRange()},
        y: {range: (_, low, high) => this.#yRange(low, high)},
      },
      axes: [
        {...axis, size: 22, gap: 4, space: 56,
         values: (_, ticks) => ticks.map((t) => `${formatTick(t)} s`)},
        {...axis, size: 46, gap: 6, space: 26,
         values: (_, ticks) => ticks.map(formatTick)},
      ],
      series: [{}].concat(shown.map((line) => ({
        stroke: this.#color(line.color),
        width: line.width ?? 1.6,
        dash: line.dash,
        points: {show: this.data[0].length === 1},
      }))),
      hooks: {
        drawAxes: [(plot) => this.#drawBands(plot)],
        draw: [(plot) => {
          this.#drawMarks(plot);
          if (this.time !== undefined && this.plot) this.update(this.time);
        }],
      },
    }, this.data, this.holder);
    this.#cursor = document.createElement('div');
    this.#cursor.className = 'time-cursor';
    this.plot.over.append(this.#cursor);
    this.#listen(this.plot.over);
    this.#buildLegend();
  }

  #drawBands(plot) {
    const {ctx, bbox} = plot;
    ctx.save();
    ctx.fillStyle = this.#color('push');
    ctx.globalAlpha = 0.13;
    for (const [from, to] of this.bands) {
      const left = Math.max(bbox.left, plot.valToPos(from, 'x', true));
      const right = Math.min(bbox.left + bbox.width,
                             plot.valToPos(to, 'x', true));
      if (right < left) continue;
      ctx.fillRect(left, bbox.top, Math.max(1, right - left), bbox.height);
    }
    ctx.restore();
  }

  #drawMarks(plot) {
    const {ctx, bbox} = plot;
    const ratio = window.devicePixelRatio || 1;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = this.#color('limit');
    ctx.lineWidth = ratio;
    ctx.font = `${10 * ratio}px system-ui, sans-serif`;
    const labels = [];
    for (const {value, name} of this.spec.marks ?? []) {
      const y = plot.valToPos(value, 'y', true);
      if (!(y >= bbox.top - 1 && y <= bbox.top + bbox.height + 1)) continue;
      ctx.setLineDash([5 * ratio, 4 * ratio]);
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      const below = y < bbox.top + 14 * ratio;
      const at = y + (below ? 11 : -4) * ratio;
      const atStart = this.#distance(value, 0) > this.#distance(value, 0.7);
      // A label beside those of marks that are as high.
      const inset = labels.filter((label) => label.atStart === atStart &&
                                  Math.abs(label.at - at) < 12 * ratio)
          .reduce((sum, label) => sum + label.width + 8 * ratio, 4 * ratio);
      ctx.textAlign = atStart ? 'left' : 'right';
      ctx.fillText(name, bbox.left + (atStart ? inset : bbox.width - inset), at);
      labels.push({atStart, at, width: ctx.measureText(name).width});
    }
    ctx.restore();
  }

  // Returns the smallest distance of the lines to a value. It looks at three
  // tenths of the shown time, from `fraction` of the shown time on.
  #distance(value, fraction) {
    const [from, to] = this.xRange();
    const start = from + fraction * (to - from);
    const end = start + 0.3 * (to - from);
    const [time, ...lines] = this.data;
    let nearest = Infinity;
    for (let i = 0; i < time.length; ++i) {
      if (time[i] < start || time[i] > end) continue;
      for (const line of lines) {
        if (line[i] == null) continue;
        nearest = Math.min(nearest, Math.abs(line[i] - value));
      }
    }
    return nearest;
  }

  // Dragging moves through time; a vertical swipe still scrolls the page.
  #listen(over) {
    const seek = (event) => {
      const box = over.getBoundingClientRect();
      this.onSeek(this.plot.posToVal(event.clientX - box.left, 'x'));
    };
    over.style.touchAction = 'pan-y';
    over.addEventListener('pointerdown', (event) => {
      over.setPointerCapture(event.pointerId);
      seek(event);
    });
    over.addEventListener('pointermove', (event) => {
      if (over.hasPointerCapture(event.pointerId)) seek(event);
    });
  }

  #buildLegend() {
    const legend = this.element.querySelector('.legend');
    legend.replaceChildren(...this.spec.lines.map((line) => {
      const item = document.createElement('li');
      item.innerHTML = '<i></i><span></span><output></output>';
      const key = item.querySelector('i');
      key.style.borderTopColor = this.#color(line.color);
      key.style.borderTopStyle = line.dash ? 'dashed' : 'solid';
      item.querySelector('span').textContent = line.name;
      return item;
    }));
    this.outputs = [...legend.querySelectorAll('output')];
  }

  /** Moves the cursor to a time and shows the values at that time. */
  update(time) {
    this.time = time;
    const x = this.plot.valToPos(time, 'x');
    const inside = x >= -1 && x <= this.plot.over.clientWidth + 1;
    this.#cursor.style.display = inside ? '' : 'none';
    this.#cursor.style.transform = `translateX(${x}px)`;
    const row = lastAtOrBefore(this.data[0], time);
    this.outputs.forEach((output, i) => {
      const value = this.data[i + 1]?.[row];
      output.textContent = formatNumber(value);
    });
  }

  /** Draws the plot again for a new time range. */
  rescale() {
    this.plot.setData(this.data, true);
  }

  #resize() {
    const width = this.holder.clientWidth;
    if (!width || width === this.plot.width) return;
    this.plot.setSize({width, height: this.plot.height});
  }
}

function lastAtOrBefore(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time + 1e-9) low = middle;
    else high = middle - 1;
  }
  return low;
}

function formatTick(value) {
  if (Math.abs(value) >= 1e6) return value.toExponential(0);
  return String(+value.toPrecision(6));
}
