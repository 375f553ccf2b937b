// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import {escapeHtml, formatNumber} from './format.js';

const horizontal = (vector) => Math.hypot(vector[0], vector[1]);

/**
 * The numbers of summary.json that have a tile at the top. `value` returns the
 * shown number in `unit`, `limit` the largest good value, `why` its meaning.
 */
const NUMBERS = [
  {
    title: 'CoM error at the end',
    unit: 'mm',
    value: (s) => Math.round(1e6 * horizontal(s.com_error_final)) / 1e3,
    limit: () => 20,
    why: 'Horizontal, mean of the last half second. Recovered: under 20 mm.',
  },
  {
    title: 'CoM error, peak',
    unit: 'mm',
    value: (s) => 1e3 * Math.max(...s.com_error_peak.slice(0, 2).map(Math.abs)),
    why: 'Largest error of the center of mass in x or y.',
  },
  {
    title: 'Impulse',
    unit: 'N·s',
    value: (s) => s.impulse_Ns,
    limit: (s) => s.lipm_Ns,
    why: (s) => s.lipm_Ns ? `${Math.round(100 * s.impulse_Ns / s.lipm_Ns)} % of ` +
        `${formatNumber(s.lipm_Ns)} N·s, the largest impulse that an inverted ` +
        'pendulum can take without a step.' :
        'Integral of the force over time, for the largest push.',
  },
  {
    title: 'CoP, peak in y',
    unit: 'mm',
    value: (s) => 1e3 * Math.abs(s.cop_peak[1]),
    why: 'Largest distance of the center of pressure from the middle of the ' +
        'feet, sideways.',
  },
  {
    title: 'Foot tilt, peak',
    unit: 'mrad',
    value: (s) => 1e3 * s.foot_tilt_peak,
    limit: () => 100,
    why: 'Largest tilt of a foot that should stay flat. Recovered: under ' +
        '100 mrad.',
  },
  {
    title: 'Foot slide, peak',
    unit: 'mm',
    value: (s) => 1e3 * s.foot_slide_peak,
    limit: () => 30,
    why: 'Largest slide of a foot since it was put down. Recovered: under ' +
        '30 mm.',
  },
  {
    title: 'Control tick, median',
    unit: 'µs',
    value: (s) => s.tick_us.median,
    limit: (s) => 1e6 * s.control_dt,
    why: (s) => `99 % take at most ${formatNumber(s.tick_us.p99)} µs, the ` +
        `longest takes ${formatNumber(s.tick_us.max)} µs. A tick may take ` +
        `${formatNumber(1e6 * s.control_dt)} µs.`,
  },
  {
    title: 'KKT residual, worst',
    unit: '',
    value: (s) => s.hqp.certificate_max,
    why: (s) => `Every solution is checked. At most ${s.hqp.iterations_max} ` +
        `iterations. ${s.hqp.failures ? `${s.hqp.failures} of ` : 'All '}` +
        `${s.ticks} ticks were ${s.hqp.failures ? 'not ' : ''}solved to the ` +
        `last level. Gaps of solved levels are at most ` +
        `${formatNumber(s.gap_max)} of the level's cost.`,
  },
];

/** Further numbers, shown below the replay. */
const MORE_NUMBERS = [
  {
    title: 'Joint limit overrun',
    unit: 'mrad',
    value: (s) => 1e3 * s.joint_limit_violation_peak,
    why: 'Largest violation of a joint limit.',
  },
  {
    title: 'Torque limit overrun',
    unit: 'N·m',
    value: (s) => s.torque_limit_violation_peak,
    why: 'Largest violation of a torque limit.',
  },
  {
    title: 'Speed',
    unit: '× real time',
    value: (s) => s.real_time_factor,
    why: 'Of controller and physics together, on the computer of the run.',
  },
  {
    title: 'LIPM at height',
    unit: 'N·s',
    value: (s) => s.lipm_height_Ns,
    why: 'Largest impulse that the inverted pendulum can take, pushed as high ' +
        'as the robot.',
  },
];

// Any key may be missing in a summary: a number that needs it is not shown.
function tryValue(compute, summary) {
  try {
    const value = compute(summary);
    return typeof value === 'string' || Number.isFinite(value) ? value : null;
  } catch {
    return null;
  }
}

function meter(value, limit) {
  if (value === null || !limit) return '';
  const part = Math.min(1, value / limit);
  return `<div class="meter"><i${value > limit ? ' class="over"' : ''}
    style="width:${(100 * part).toFixed(1)}%"></i></div>`;
}

function valueHtml(value, unit, over) {
  return `<dd class="value${over ? ' over' : ''}">${formatNumber(value)}` +
      `<small>${unit}</small></dd>`;
}

function tilesHtml(numbers, runs) {
  const tiles = [];
  for (const number of numbers) {
    const shown = runs.map(({summary}) => {
      const value = tryValue(number.value, summary);
      const limit = number.limit ? tryValue(number.limit, summary) : null;
      return {value, limit, over: limit !== null && value > limit};
    });
    if (shown.every(({value}) => value === null)) continue;
    const why = typeof number.why === 'string' ?
        number.why : tryValue(number.why, runs[0].summary) ?? '';
    let body;
    if (runs.length === 1) {
      const [{value, limit, over}] = shown;
      body = valueHtml(value, number.unit, over) + meter(value, limit) +
          `<dd class="why">${escapeHtml(why)}</dd>`;
    } else {
      body = shown.map(({value, over}, i) => `<div class="pair">
        <span class="tag ${'ab'[i]}">${'AB'[i]}</span>
        ${valueHtml(value, number.unit, over)}</div>`).join('') +
          (typeof number.why === 'string' ?
              `<dd class="why">${escapeHtml(why)}</dd>` : '');
    }
    tiles.push(`<dl class="tile"><dt>${number.title}</dt>${body}</dl>`);
  }
  return tiles.length ? `<div class="tiles">${tiles.join('')}</div>` : '';
}

/** Returns the tiles of one run, or of two in pairs. '' without a summary. */
export function numbersHtml(runs) {
  return tilesHtml(NUMBERS, runs);
}

export function moreNumbersHtml(runs) {
  return tilesHtml(MORE_NUMBERS, runs);
}

/** Returns a badge that shows how a run ended. */
export function verdictHtml({summary}) {
  if (summary.interrupted === true && !Number.isFinite(summary.fell_at)) {
    return '<span class="verdict none">Interrupted</span>';
  }
  if (summary.recovered === true) {
    return '<span class="verdict">Recovered</span>';
  }
  if (summary.recovered === false) {
    const when = Number.isFinite(summary.fell_at) ?
        `Fell at ${summary.fell_at.toFixed(2)} s` : 'Not recovered at the end';
    return `<span class="verdict bad">${when}</span>`;
  }
  return '<span class="verdict none">No verdict</span>';
}
