// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The page of one run, or of two runs at the same time. It combines all views.
import {Clock} from './clock.js';
import {convexHull} from './geometry.js';
import {readRuns} from './feed.js';
import {escapeHtml, formatNumber, titleOf} from './format.js';
import {GroundMap} from './ground_map.js';
import {moreNumbersHtml, numbersHtml, verdictHtml} from './numbers.js';
import {readPalette, Theme, THEME_BUTTON} from './palette.js';
import {Plot} from './plots.js';
import {pushesText} from './pushes.js';
import {fillPlots, plotsOf, timingPlot, torquePlot} from './specs.js';
import {Stage} from './stage.js';
import {activeRows, residualRows, statusRows, Strip, torqueRows,
  touchingRows} from './strips.js';
import style from './style.css';
import {Transport} from './transport.js';

const KEYS = [
  ['com', 'Center of mass'], ['cop', 'Center of pressure (ZMP)'],
  ['capture', 'Capture point'], ['support', 'Support polygon'],
  ['force', 'Force on a foot'], ['push', 'Push'],
];

const VIEW_NAMES = [['three_quarter', '3D'], ['front', 'Front'],
                    ['side', 'Side'], ['top', 'Top']];

const pushOf = ({summary}) => pushesText(summary);

function describe(run) {
  const {summary: s, robot, rows} = run;
  return [
    pushOf(run),
    changesOf(run),
    budgetOf(run),
    s.fell_by && `fell: ${s.fell_by}`,
    robot && `${robot.name}, ${robot.bodies.length - 1} joints, ` +
        `${formatNumber(robot.mass)} kg`,
    s.plant && `plant ${s.plant}`,
    s.control_dt > 0 && `${formatNumber(1 / s.control_dt)} Hz`,
    s.seed !== undefined && `seed ${s.seed}`,
    `${rows} tick${rows === 1 ? '' : 's'}`,
  ].filter(Boolean).join(' · ');
}

/** Returns the changes of a run to its task set: "without cop, yaw". */
function changesOf({summary: {tasks}}) {
  if (!tasks) return '';
  return [tasks.set !== 'default' && `tasks ${tasks.set}`,
    tasks.with?.length && `with ${tasks.with.join(', ')}`,
    tasks.without?.length && `without ${tasks.without.join(', ')}`]
      .filter(Boolean).join(', ');
}

/** Returns the limit of the solver's time: "budget 300 µs", or "no budget". */
function budgetOf({summary: {hqp}}) {
  if (!hqp) return '';
  if (!(hqp.budget_us > 0)) return 'no budget';
  return `budget ${formatNumber(hqp.budget_us)} µs` +
      (hqp.budget_clock ? ' by the clock' : '');
}

/** Returns a short label: the first trait in which a run differs from others. */
function labelOf(run, runs) {
  const traits = [
    nameOf, pushOf, changesOf, budgetOf, ({summary}) => summary.plant,
    ({robot}) => robot?.name, ({summary}) => `seed ${summary.seed}`,
  ];
  const trait = traits.find(
      (each) => runs.some((other) => each(other) !== each(run)));
  return trait?.(run) || pushOf(run) || nameOf(run);
}

const nameOf = (run) => titleOf(run.summary.scenario ?? run.name);

const tagHtml = ({label}) =>
  `<span class="tag ${label.toLowerCase()}">${label}</span>`;

function headHtml(runs) {
  if (runs.length === 1) {
    const [run] = runs;
    return `<header class="head"><div class="titles">
      <p class="brand">Poise</p><h1>${escapeHtml(nameOf(run))}</h1>
      <p class="what">${escapeHtml(describe(run))}</p></div>
      ${verdictHtml(run)}${THEME_BUTTON}</header>`;
  }
  const line = (run) => `<div class="run">${tagHtml(run)}<p class="what">
    <b>${escapeHtml(nameOf(run))}</b>
    ${escapeHtml(describe(run))}</p></div>`;
  return `<header class="head"><div class="titles"><p class="brand">Poise</p>
    <h1>Two runs side by side</h1>${runs.map(line).join('')}</div>${THEME_BUTTON}</header>`;
}

function notesHtml(runs) {
  const notes = runs.flatMap((run) => run.notes.map(
      (note) => runs.length > 1 ? `${run.label}: ${note}` : note));
  return notes.length ? `<div class="notes" role="status">${
    notes.map((note) => `<p>${escapeHtml(note)}</p>`).join('')}</div>` : '';
}

function footerHtml(runs) {
  const hash = runs.map(({summary}) => summary.log_sha256).filter(Boolean)
      .map((sum) => sum.slice(0, 12)).join(' and ');
  return `<footer><p>The page shows the simulator's true values, not the
    controller's estimates. Values are stored in 16 bits over the range of each
    quantity. Long logs are thinned, but keep their peaks${
      hash ? `. SHA-256 of log.csv: ${hash}…` : ''}.</p>
    <p>Drag in a plot or in the time bar to move through time. Space plays and
    pauses, an arrow key steps by 20 ms, with Shift by 1 ms. Ctrl and the mouse
    wheel zoom the plots.</p>
    </footer>`;
}

/** The page with all its views, which follow one clock. */
class Page {
  #views = [];

  constructor(root, runs) {
    this.runs = runs;
    this.theme = new Theme((palette) => this.#recolor(palette));
    const start = Math.min(...runs.map((run) => run.start));
    const end = Math.max(...runs.map((run) => run.end));
    this.clock = new Clock(start, end);
    this.range = [start, end > start ? end : start + 1];
    root.classList.toggle('compare', runs.length > 1);
    // A page inside another page does not show its own header.
    root.classList.toggle('embedded', /\bembed\b/.test(location.hash));
    root.innerHTML = `${headHtml(runs)}${notesHtml(runs)}${numbersHtml(runs)}
      <div class="work"><div class="left"><div class="stages"></div>
      <div class="under"><ul class="keys">${KEYS.map(([name, text]) =>
        `<li><i class="${name}"></i>${text}</li>`).join('')}</ul>
      <div class="views" role="group" aria-label="Viewpoint">${
        VIEW_NAMES.map(([view, text]) =>
          `<button data-view="${view}">${text}</button>`).join('')}</div></div>
      ${moreNumbersHtml(runs)}</div>
      <div class="instruments"><div class="ranges"></div></div></div>
      ${footerHtml(runs)}`;
    root.querySelector('.theme').addEventListener(
        'click', () => this.theme.toggle());
    this.left = root.querySelector('.left');
    this.instruments = root.querySelector('.instruments');
    this.#addStages(root.querySelector('.stages'));
    this.transport = new Transport(this.left, this.clock, {
      pushes: runs[0].pushes,
      falls: runs.map(({summary}) => summary.fell_at).filter(Number.isFinite),
    });
    this.left.querySelector('.stages').after(this.transport.element);
    this.#addRanges();
    this.#addInstruments();
    this.#listenToZoom();
    this.clock.listen(() => this.#update());
    const hash = /\bt=([\d.]+)/.exec(location.hash);
    this.clock.seek(hash ? Number(hash[1]) : start);
    const frame = (now) => {
      this.clock.frame(now);
      for (const {stage} of this.stages) stage?.render();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  #addStages(parent) {
    const palette = readPalette();
    this.stages = this.runs.map((run) => {
      const element = document.createElement('div');
      element.className = 'stage';
      parent.append(element);
      element.innerHTML = `<div class="who"></div>
        <canvas class="ground" aria-label="The ground from above"></canvas>
        <span class="labels"></span><span class="event"></span>`;
      if (this.runs.length > 1) {
        element.querySelector('.who').innerHTML =
            `${tagHtml(run)}<b>${escapeHtml(labelOf(run, this.runs))}</b>` +
            verdictHtml(run);
      }
      const problem = !run.robot ?
          'robot.json is missing: the robot cannot be drawn.' :
          !run.motion.rows ? 'The log has no rows: there is no motion.' : '';
      let stage = null;
      try {
        stage = new Stage(element, run, palette);
      } catch (error) {
        console.warn(error);
        element.insertAdjacentHTML(
            'beforeend', '<div class="nothing">This browser has no WebGL 2, ' +
            'which the 3D replay needs. The plots still work.</div>');
      }
      if (problem) {
        element.insertAdjacentHTML(
            'beforeend', `<div class="nothing">${problem}</div>`);
      }
      const map = stage && run.robot ?
          new GroundMap(element.querySelector('.ground'), stage, palette) : null;
      element.querySelector('.ground').hidden = !map;
      if (run.robot && stage) run.soleEdges = soleEdgesOf(stage);
      return {run, stage, map, element, labels: element.querySelector('.labels'),
              event: element.querySelector('.event')};
    });
    this.left.querySelector('.views').addEventListener('click', (event) => {
      const {view} = event.target.dataset;
      if (!view) return;
      for (const {stage} of this.stages) stage?.setView(view);
      this.#update();
    });
    for (const {stage} of this.stages) {
      stage?.onCamera(() => {
        for (const other of this.stages) {
          if (other.stage && other.stage !== stage) other.stage.copyCamera(stage);
        }
        this.#labels();
      });
    }
  }

  #addRanges() {
    const bar = this.instruments.querySelector('.ranges');
    const pushes = this.runs[0].pushes;
    const choices = [['Whole run', this.range]];
    if (pushes.length) {
      const [from] = pushes[0];
      choices.push(['The push', [Math.max(this.clock.start, from - 0.25),
                                 Math.min(this.clock.end, from + 2)]]);
    }
    bar.innerHTML = '<span>Plots show</span>';
    for (const [text, range] of choices) {
      const button = document.createElement('button');
      button.textContent = text;
      button.addEventListener('click', () => this.setRange(range));
      button.range = range;
      bar.append(button);
    }
    this.rangeButtons = [...bar.querySelectorAll('button')];
    this.#markRange();
  }

  #markRange() {
    for (const button of this.rangeButtons) {
      button.setAttribute('aria-pressed', String(button.range.every(
          (edge, i) => Math.abs(edge - this.range[i]) < 1e-9)));
    }
  }

  setRange([from, to]) {
    const {start} = this.clock;
    const end = Math.max(this.clock.end, start + 0.01);
    const width = Math.min(end - start, Math.max(0.02, to - from));
    const left = Math.min(Math.max(start, from), end - width);
    this.range = [left, left + width];
    this.#markRange();
    for (const view of this.#views) view.rescale();
  }

  #options() {
    return {
      palette: readPalette(),
      xRange: () => this.range,
      bands: this.runs[0].pushes,
      onSeek: (time) => {
        this.clock.pause();
        this.clock.seek(time);
      },
    };
  }

  #addInstruments() {
    const options = this.#options();
    const {instruments, runs} = this;
    const add = (specs) => specs.map((spec) => {
      if (spec.lines.length === 0) return null;
      const plot = new Plot(instruments, spec, options);
      this.#views.push(plot);
      return plot;
    });
    const strip = (spec) =>
      this.#views.push(new Strip(instruments, spec, options));
    const tagged = (title, run) =>
      runs.length === 1 ? title : `${tagHtml(run)} ${title}`;

    const count = plotsOf(runs[0]).length;
    const plotsFrom = (from, to) => {
      for (let i = from; i < to; ++i) {
        add(fillPlots(runs, (run) => plotsOf(run)[i], (run) => run.signals));
      }
    };
    plotsFrom(0, 4);
    for (const run of runs) {
      if (run.rows === 0) continue;
      strip({
        title: tagged('Active constraints', run),
        hint: 'Inequalities that limited the solution; darker where their ' +
            'multiplier is larger.',
        rows: activeRows(run), few: 14, empty: 'No constraint was active.',
      });
      const residuals = residualRows(run);
      if (residuals.length) {
        strip({
          title: tagged('Residual of each task', run),
          hint: 'Darker where larger; the number is the largest residual. ' +
              'Tasks without residual are left out.',
          rows: residuals, few: 8,
        });
      }
      const status = statusRows(run);
      if (status.length) {
        strip({title: tagged('Status other than ok', run), rows: status, few: 6});
      }
      const touching = touchingRows(run);
      if (touching.length) {
        strip({
          title: tagged('Links that touched each other', run),
          hint: 'Contacts with the ground are not shown.',
          rows: touching, few: 6,
        });
      }
    }
    this.#addTorques(add, strip, tagged);
    add(fillPlots(runs, timingPlot, (run) => run.timing));
    plotsFrom(4, count);
  }

  #addTorques(add, strip, tagged) {
    const {runs} = this;
    const joints = runs[0].torques.names.map((name) => name.slice(4));
    if (joints.length === 0 || runs[0].torques.rows === 0) return;
    const worst = torqueRows(runs[0])[0]?.name ?? joints[0];
    const select = document.createElement('select');
    select.setAttribute('aria-label', 'Joint');
    select.innerHTML = joints.map((joint) => `<option${
      joint === worst ? ' selected' : ''}>${escapeHtml(joint)}</option>`).join('');
    const specFor = (joint) => fillPlots(
        runs, (run) => torquePlot(run, joint), (run) => run.torques)[0];
    const [plot] = add([{...specFor(worst), control: select}]);
    const show = (joint) => {
      select.value = joint;
      plot.change(specFor(joint));
    };
    select.addEventListener('change', () => show(select.value));
    for (const run of runs) {
      strip({
        title: tagged('Torque, relative to its limit', run),
        hint: 'Joints by largest peak; choose one to plot its torque.',
        rows: torqueRows(run), few: 10, onPick: show,
        empty: 'robot.json has no torque limits.',
      });
    }
  }

  #listenToZoom() {
    this.instruments.addEventListener('wheel', (event) => {
      const lane = event.target.closest('.u-over, .lane');
      if (!event.ctrlKey || !lane) return;
      event.preventDefault();
      const box = lane.getBoundingClientRect();
      const part = (event.clientX - box.left) / box.width;
      const [from, to] = this.range;
      const middle = from + part * (to - from);
      const factor = Math.exp(0.0025 * event.deltaY);
      this.setRange([middle - (middle - from) * factor,
                     middle + (to - middle) * factor]);
    }, {passive: false});
  }

  #recolor(palette) {
    for (const {stage, map} of this.stages ?? []) {
      stage?.setPalette(palette);
      map?.setPalette(palette);
    }
    for (const view of this.#views) view.setPalette(palette);
    if (this.clock) this.#update();
  }

  #labels() {
    for (const {stage, labels} of this.stages) {
      const pushes = stage?.robot ? stage.pushes : [];
      while (labels.children.length < pushes.length) {
        labels.append(Object.assign(document.createElement('span'),
                                    {className: 'label'}));
      }
      [...labels.children].forEach((label, i) => {
        label.hidden = i >= pushes.length;
        if (label.hidden) return;
        const {newtons, tail} = pushes[i];
        const [x, y] = stage.project(tail);
        label.textContent = `${formatNumber(newtons)} N`;
        label.style.transform =
            `translate(${x}px, ${y}px) translate(-50%, -150%)`;
      });
    }
  }

  #update() {
    const {time} = this.clock;
    for (const {run, stage, map, event} of this.stages) {
      stage?.update(time);
      map?.draw(Math.min(time, run.end));
      const {fell_at: fell} = run.summary;
      event.textContent = Number.isFinite(fell) && time >= fell ? 'Fallen' :
          time > run.end + 1e-6 ? 'The run has ended' : '';
    }
    for (const view of this.#views) view.update(time);
    this.#labels();
  }
}

/** Returns the extent of the soles' hull in the mid-feet frame, at the start. */
function soleEdgesOf(stage) {
  const {contacts, robot} = stage;
  const hull = convexHull(contacts?.feet.flatMap((foot) => foot.sole) ?? []);
  if (hull.length < 3) return undefined;
  const frames = robot.feet.map(({frame}) => frame.matrixWorld.elements);
  const mean = (index) =>
    frames.reduce((sum, elements) => sum + elements[index], 0) / frames.length;
  const yaw = Math.atan2(mean(1), mean(0));
  const at = [mean(12), mean(13)];
  const local = hull.map(([x, y]) => {
    const [dx, dy] = [x - at[0], y - at[1]];
    return [Math.cos(yaw) * dx + Math.sin(yaw) * dy,
            Math.cos(yaw) * dy - Math.sin(yaw) * dx];
  });
  const extent = (i) => [Math.min(...local.map((point) => point[i])),
                         Math.max(...local.map((point) => point[i]))];
  return {x: extent(0), y: extent(1)};
}

function main() {
  const sheet = document.createElement('style');
  sheet.textContent = style;
  document.head.append(sheet);
  const root = document.getElementById('page');
  try {
    const runs = readRuns(document.getElementById('data').textContent);
    document.title = `Poise: ${runs.map(nameOf).join(' and ')}`;
    window.poise = new Page(root, runs);
  } catch (error) {
    root.innerHTML = `<div class="broken"><h1>This page cannot be shown</h1>
      <p>${escapeHtml(error.message)}</p></div>`;
    throw error;
  }
}

main();
