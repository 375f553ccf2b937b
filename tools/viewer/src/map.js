// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The push map: the largest impulse from which the robot recovers, by direction,
// compared with the impulse that a pendulum can take. A click on a point replays
// its runs.
import {escapeHtml, formatNumber} from './format.js';
import {readPalette, Theme, THEME_BUTTON} from './palette.js';
import style from './style.css';
import mapStyle from './map.css';

const SIZE = 640;
const CENTER = SIZE / 2;
const RADIUS = 0.39 * SIZE;
const COLORS = ['c1', 'c2', 'c3', 'c4'];

/** Returns "-cop-yaw+yaw_constant" as "without cop, yaw, with yaw_constant". */
function nameOfTasks(tasks) {
  if (tasks === 'default') return 'Default hierarchy';
  const changes = tasks.match(/[+-][^+-]+/g) ?? [tasks];
  const named = (sign, word) => {
    const names = changes.filter((change) => change[0] === sign)
        .map((change) => change.slice(1));
    return names.length ? `${word} ${names.join(', ')}` : '';
  };
  return [named('-', 'without'), named('+', 'with')].filter(Boolean).join(', ');
}

/** Returns a ring's impulses relative to the pendulum: "78–84 % of LIPM". */
function shareOf(ring) {
  const shares = ring.map((row) => Math.round(100 * row.eta))
      .filter(Number.isFinite);
  if (!shares.length) return '';
  const [least, most] = [Math.min(...shares), Math.max(...shares)];
  return `: ${least === most ? least : `${least}–${most}`} % of LIPM`;
}

/** Returns a round step that gives about four rings up to a value. */
function ringStep(value) {
  const step = 10 ** Math.floor(Math.log10(value / 4));
  for (const factor of [1, 2, 5]) {
    if (value / (factor * step) <= 5) return factor * step;
  }
  return 10 * step;
}

class PushMap {
  constructor(root, {rows, robot, scenario, note}) {
    this.rows = rows;
    this.root = root;
    this.durations = [...new Set(rows.map((row) => row.duration_s))]
        .sort((a, b) => a - b);
    this.duration = this.durations[0];
    // The default task set is first, in any order of the file.
    this.tasks = [...new Set(rows.map((row) => row.tasks))].sort(
        (a, b) => (b === 'default') - (a === 'default'));
    this.theme = new Theme(() => this.draw());
    root.className = 'push-map';
    root.innerHTML = `<header class="head"><div class="titles">
      <p class="brand">Poise</p><h1>Push map</h1><p class="what">${escapeHtml(
        [robot, scenario, 'largest impulse recovered from, N·s'].filter(Boolean)
            .join(' · '))}</p></div>
      <div class="durations" role="group" aria-label="Duration of the push"></div>
      ${THEME_BUTTON}</header>
      ${note ? `<div class="notes"><p>${escapeHtml(note)}</p></div>` : ''}
      <div class="map-work"><div class="polar"></div><div class="replay">
      <p class="ask">Choose a point to replay two runs in its direction: the
      strongest push from which the robot recovered, and the weakest push from
      which it did not.</p>
      </div></div><div class="table"></div>
      <footer><p>Each point was found by bisection. It is the largest impulse only
      if the robot also recovers from every smaller one. <b>LIPM</b>: the largest
      impulse that a linear inverted pendulum on the same feet can take without a
      step, pushed at its mass. <b>LIPM at height</b>: the same for a push as high
      as the robot's, if the pendulum does not rotate. A robot can exceed this
      value with its arms and trunk.</p>
      </footer>`;
    root.querySelector('.theme').addEventListener(
        'click', () => this.theme.toggle());
    this.#addDurations();
    this.draw();
  }

  #addDurations() {
    const bar = this.root.querySelector('.durations');
    if (this.durations.length < 2) return;
    for (const duration of this.durations) {
      const button = document.createElement('button');
      button.textContent = `${duration} s`;
      button.setAttribute('aria-pressed', duration === this.duration);
      button.addEventListener('click', () => {
        this.duration = duration;
        for (const each of bar.children) {
          each.setAttribute('aria-pressed', each === button);
        }
        this.draw();
      });
      bar.append(button);
    }
  }

  /** Returns the rows of a task set, sorted by direction. */
  #ring(tasks) {
    return this.rows.filter((row) => row.tasks === tasks &&
                            row.duration_s === this.duration)
        .sort((a, b) => a.direction_deg - b.direction_deg);
  }

  draw() {
    if (!this.rows) return;
    const rings = this.tasks.map((tasks) => this.#ring(tasks));
    const all = rings.flat();
    const most = Math.max(1, ...all.flatMap(
        (row) => [row.impulse_Ns, row.lipm_Ns, row.lipm_height_Ns]
            .filter(Number.isFinite)));
    const step = ringStep(most);
    const outer = step * Math.ceil(most / step);
    // Forward (0°) is up, left (90°) is left.
    const at = (direction, value) => {
      const angle = direction * Math.PI / 180;
      const radius = RADIUS * value / outer;
      return [CENTER - radius * Math.sin(angle),
              CENTER - radius * Math.cos(angle)];
    };
    const path = (ring, key) => {
      const points = ring.filter((row) => Number.isFinite(row[key]))
          .map((row) => at(row.direction_deg, row[key])
              .map((x) => x.toFixed(1)).join(' '));
      return points.length > 1 ? `M${points.join('L')}Z` : '';
    };
    const color = (i) => `var(--${COLORS[i % COLORS.length]})`;
    let svg = '';
    for (let value = step; value <= outer + 1e-9; value += step) {
      svg += `<circle class="ring" cx="${CENTER}" cy="${CENTER}"
        r="${(RADIUS * value / outer).toFixed(1)}"/>`;
    }
    for (let direction = 0; direction < 360; direction += 45) {
      const [x, y] = at(direction, outer);
      const [tx, ty] = at(direction, outer * 1.1);
      const name = {0: 'forward', 90: 'left', 180: 'back', 270: 'right'}[direction];
      svg += `<line class="ring" x1="${CENTER}" y1="${CENTER}" x2="${x}" y2="${y}"/>
        <text class="way" x="${tx}" y="${ty + 4}">${name ?? `${direction}°`}</text>`;
    }
    const lipm = rings.find((ring) => ring.length) ?? [];
    svg += `<path class="lipm" d="${path(lipm, 'lipm_Ns')}"/>
      <path class="lipm height" d="${path(lipm, 'lipm_height_Ns')}"/>`;
    rings.forEach((ring, i) => {
      svg += `<path class="reached" style="--c:${color(i)}"
        d="${path(ring, 'impulse_Ns')}"/>`;
    });
    // The labels of the scale are midway between two directions, near 22.5°,
    // where no point lies.
    const count = new Set(all.map((row) => row.direction_deg)).size;
    const gap = Math.min(45, 360 / count);
    const between = gap * (Math.floor(22.5 / gap) + 0.5);
    for (let value = step; value <= outer + 1e-9; value += step) {
      const [x, y] = at(between, value);
      const unit = value + step > outer + 1e-9 ? ' N·s' : '';
      svg += `<text class="scale" x="${x}" y="${y + 4}">${
        +value.toPrecision(6)}${unit}</text>`;
    }
    rings.forEach((ring, i) => {
      for (const row of ring) {
        const [x, y] = at(row.direction_deg, row.impulse_Ns);
        svg += `<circle class="point" tabindex="0" role="button"
          style="--c:${color(i)}" cx="${x.toFixed(1)}" cy="${y.toFixed(1)}" r="6"
          data-row="${this.rows.indexOf(row)}"><title>${row.direction_deg}°:
          ${formatNumber(row.impulse_Ns)} N·s, ${Math.round(100 * row.eta)} % of
          the pendulum's ${formatNumber(row.lipm_Ns)}</title></circle>`;
      }
    });
    this.root.querySelector('.polar').innerHTML = `
      <svg viewBox="0 0 ${SIZE} ${SIZE}" role="img"
        aria-label="Recovered impulse by direction">${svg}</svg>
      <ul class="map-keys">${this.tasks.map((tasks, i) =>
        `<li><i style="background:${color(i)}"></i>${
          escapeHtml(nameOfTasks(tasks) + shareOf(rings[i]))}</li>`).join('')}
      <li><i class="dash"></i>LIPM</li>
      <li><i class="dash height"></i>LIPM at height</li></ul>`;
    for (const point of this.root.querySelectorAll('.point')) {
      const row = this.rows[point.dataset.row];
      const open = () => this.#replay(row, point);
      point.addEventListener('click', open);
      point.addEventListener('keydown', (event) => {
        if (event.key === 'Enter' || event.key === ' ') {
          event.preventDefault();
          open();
        }
      });
    }
    this.#drawTable(rings);
  }

  #drawTable(rings) {
    const rows = rings.flat().map((row) => `<tr>
      <td>${row.direction_deg}°</td><td>${escapeHtml(nameOfTasks(row.tasks))}</td>
      <td>${formatNumber(row.impulse_Ns)}</td><td>${formatNumber(row.lipm_Ns)}</td>
      <td>${formatNumber(row.eta)}</td>
      <td>${formatNumber(row.lipm_height_Ns)}</td>
      <td>${formatNumber(row.impulse_Ns / row.lipm_height_Ns)}</td></tr>`);
    this.root.querySelector('.table').innerHTML = `<details><summary>All numbers
      </summary><table><thead><tr><th>Direction</th><th>Tasks</th>
      <th>Recovered, N·s</th><th>LIPM, N·s</th><th>η</th>
      <th>LIPM at height, N·s</th><th>η at height</th></tr></thead>
      <tbody>${rows.join('')}</tbody></table></details>`;
  }

  #replay(row, point) {
    for (const each of this.root.querySelectorAll('.point.chosen')) {
      each.classList.remove('chosen');
    }
    point.classList.add('chosen');
    const replay = this.root.querySelector('.replay');
    const title = `${row.direction_deg}°, ${row.duration_s} s, ` +
        `${nameOfTasks(row.tasks)}: ${formatNumber(row.impulse_Ns)} N·s`;
    if (!row.replay) {
      replay.innerHTML = `<p class="ask">${escapeHtml(title)}: there is no replay
        of this point.</p>`;
      return;
    }
    // The theme is in the address: pages from disk cannot share storage.
    const theme = readPalette().dark ? 'dark' : 'light';
    replay.innerHTML = `<p class="which"><b>${escapeHtml(title)}</b>
      <a href="${encodeURI(row.replay)}" target="_blank">Open alone</a></p>
      <iframe title="${escapeHtml(title)}"
        src="${encodeURI(row.replay)}#embed&theme=${theme}"></iframe>`;
  }
}

function main() {
  const sheet = document.createElement('style');
  sheet.textContent = style + mapStyle;
  document.head.append(sheet);
  const root = document.getElementById('page');
  const data = JSON.parse(document.getElementById('data').textContent);
  if (data.format !== 'poise-map-1') {
    root.textContent = `The data of this page has the format "${data.format}", ` +
        'but must have "poise-map-1".';
    return;
  }
  window.poise = new PushMap(root, data);
}

main();
