// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Tests that need no browser: data, time, geometry, numbers as text.
import assert from 'node:assert/strict';
import test from 'node:test';
import {Clock} from '../src/clock.js';
import {decodeChannel, decodeFloats, Run, Table} from '../src/feed.js';
import {footprintsOf} from '../src/footprints.js';
import {formatNumber, titleOf} from '../src/format.js';
import {convexHull, copOf} from '../src/geometry.js';
import {mostAtOnce, pushesText} from '../src/pushes.js';
import {timingPlot, torquePlot} from '../src/specs.js';

const base64 = (array) =>
  Buffer.from(array.buffer, array.byteOffset, array.byteLength)
      .toString('base64');

const channel = (name, min, max, steps) =>
  ({name, unit: '', min, max, data: base64(Uint16Array.from(steps))});

const table = (time, ...channels) => ({
  rows: time.length, time: base64(Float32Array.from(time)), channels,
});

test('a channel is decoded as tools/commands/report/channel.h defines', () => {
  const values = decodeChannel(channel('q', -1, 3, [0, 65534, 32767, 65535]));
  assert.deepEqual([...values.slice(0, 3)], [-1, 3, 1]);
  assert.ok(Number.isNaN(values[3]));
});

test('floats keep their bits', () => {
  assert.deepEqual([...decodeFloats('AACAPwAAgD8=')], [1, 1]);
});

test('a table is linear between its rows and constant outside', () => {
  const data = new Table(table([0, 1, 3], channel('a', 0, 4, [0, 32767, 65534])));
  assert.equal(data.at('a', -5), 0);
  assert.equal(data.at('a', 0.5), 1);
  assert.equal(data.at('a', 1), 2);
  assert.equal(data.at('a', 2), 3);
  assert.equal(data.at('a', 9), 4);
  assert.equal(data.at('b', 1, 7), 7);
  assert.equal(data.row(0.999), 0);
  assert.equal(data.row(1), 1);
});

test('an empty table has no rows and no values', () => {
  const data = new Table(null);
  assert.equal(data.rows, 0);
  assert.equal(data.at('a', 1, 7), 7);
});

test('a run finds the times of its pushes and its capture point', () => {
  const still = (name) => channel(name, 0, 0, [0, 0, 0, 0]);
  const run = new Run({
    name: 'r', summary: null, robot: null, notes: [], timing: null,
    log: {
      rows: 4,
      motion: table([0, 1, 2, 3],
                    channel('com.x', 0, 3, [0, 21845, 43689, 65534]),
                    still('com.y'), channel('com.z', 0.8, 0.8, [0, 0, 0, 0])),
      signals: table([0, 1, 2, 3], still('push.fx'),
                     channel('push.fy', 0, 100, [0, 65534, 65534, 0]),
                     still('push.fz')),
      torques: table([]), active: [], status: [],
    },
  }, 'A');
  assert.deepEqual(run.pushes, [[1, 3]]);
  assert.deepEqual(run.push(1.5), [0, 100, 0]);
  assert.deepEqual(run.push(0.9), [0, 0, 0]);
  assert.equal(run.start, 0);
  assert.equal(run.end, 3);
  // The CoM moves at 1 m/s at a height of 0.8 m, so the capture point is ahead
  // by sqrt(0.8 / 9.81) s times 1 m/s.
  const [x, y] = run.capturePoint(1.5);
  assert.ok(Math.abs(x - (1.5 + Math.sqrt(0.8 / 9.81))) < 1e-3, String(x));
  assert.ok(Math.abs(y) < 1e-9);
});

test('each push keeps its own force, shape and point', () => {
  const box = {
    link: 'head', body: 3, point: [0, 0, 0.1], force: [30, 0, 0],
    frame: 'world', at: 1, duration: 1, shape: 'box', impulse_Ns: 30,
  };
  const sine = {
    link: 'torso', body: 2, point: [0.1, 0, 0], force: [0, 100, 0],
    frame: 'world', at: 1.5, duration: 1, shape: 'half_sine',
    impulse_Ns: 200 / Math.PI,
  };
  const hit = {...box, at: 2.6, duration: 0.1, shape: 'impulse', impulse_Ns: 3};
  const still = (name) => channel(name, 0, 0, [0, 0]);
  const summary = {
    pushes: [box, sine, hit], control_dt: 0.002, impulse_Ns: 200 / Math.PI,
    push_duration: 1, push_link: 'torso', push_body: 2, push_point: [0.1, 0, 0],
  };
  const run = new Run({
    name: 'r', summary, robot: null, notes: [], timing: null,
    log: {
      rows: 2, motion: table([0, 3], still('com.x')),
      signals: table([0, 3], still('com.x')), torques: table([]),
    },
  }, 'A');
  const at = (time) => run.pushesAt(time).map(
      ({body, point, force}) => [body, point, force.map(Math.round)]);
  assert.deepEqual(at(0.9), []);
  assert.deepEqual(at(1.2), [[3, [0, 0, 0.1], [30, 0, 0]]]);
  assert.deepEqual(at(1.75), [[3, [0, 0, 0.1], [30, 0, 0]],
                              [2, [0.1, 0, 0], [0, 71, 0]]]);
  assert.deepEqual(at(2), [[2, [0.1, 0, 0], [0, 100, 0]]]);
  assert.deepEqual(at(2.6), [[3, [0, 0, 0.1], [1500, 0, 0]]]);
  assert.deepEqual(at(2.602), []);
  assert.equal(mostAtOnce(summary.pushes), 2);
  assert.equal(
      pushesText(summary),
      '30.0 N for 1.00 s on head, then half sine of 100 N for 1.00 s on torso' +
      ', then 3.00 N·s at once on head');
  // Summaries of older versions do not contain the force, and the mean is not
  // the force.
  assert.equal(pushesText({impulse_Ns: 15, push_duration: 0.15}), '15.0 N·s');
});

test('a clock plays at its speed, stops at the end, and starts again', () => {
  const clock = new Clock(0, 1);
  let told = 0;
  clock.listen(() => ++told);
  clock.setSpeed(0.5);
  clock.play();
  clock.frame(1000);
  clock.frame(1050);
  assert.ok(Math.abs(clock.time - 0.025) < 1e-12);
  // After a pause without frames the clock does not jump.
  clock.frame(60000);
  assert.ok(Math.abs(clock.time - 0.075) < 1e-12);
  clock.seek(0.99);
  clock.frame(60100);
  assert.equal(clock.time, 1);
  assert.equal(clock.playing, false);
  clock.toggle();
  assert.equal(clock.time, 0);
  assert.equal(clock.playing, true);
  clock.seek(7);
  assert.equal(clock.time, 1);
  assert.ok(told > 5);
});

test('a clock with equal start and end does not play', () => {
  const clock = new Clock(2, 2);
  clock.play();
  assert.equal(clock.playing, false);
});

test('a convex hull is counterclockwise and without inner points', () => {
  const hull = convexHull(
      [[0, 0], [1, 0], [0.5, 0.5], [1, 1], [0, 1], [0.5, 0]]);
  assert.deepEqual(hull, [[0, 0], [1, 0], [1, 1], [0, 1]]);
  assert.deepEqual(convexHull([[1, 2]]), [[1, 2]]);
  assert.deepEqual(convexHull([]), []);
});

test('the center of pressure is where the force acts', () => {
  // A force of 100 N at (0.03, -0.02) has the moment m = p x f.
  assert.deepEqual(copOf({mx: -2, my: -3, fz: 100}), [0.03, -0.02]);
  assert.equal(copOf({mx: 0, my: 0, fz: 0}), null);
});

test('numbers are short, and NaN is shown as a dash', () => {
  assert.deepEqual(
      [0, 12.345, -0.4567, 123.4, 1234567, 3e-11, NaN, undefined, Infinity]
          .map(formatNumber),
      ['0', '12.3', '−0.46', '123', '1.2e6', '3.0e−11', '–', '–', '∞']);
  assert.equal(titleOf('strong_push_without_zmp'), 'Strong push without zmp');
});

test('footprints are the soles at the start and at each landing', () => {
  const motion = table([0, 1, 2],
      channel('plan.x', 0, 1, [65535, 65534, 65535]),
      channel('plan.y', 0, 1, [65535, 0, 65535]),
      channel('left.x', 0, 1, [0, 65534, 65534]),
      channel('left.y', 0, 1, [0, 0, 0]), channel('left.z', 0, 1, [0, 0, 0]));
  const steps = [
    {foot: 'left', at: 0.5, swing_s: 0.75, landed: [1, 0.5]},
    {foot: 'right', at: 1.5, landed: null},
  ];
  const run = new Run({name: 'run', log: {rows: 3, motion}, summary: {steps}},
                      'A');
  const sole = [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]];
  const prints = footprintsOf(run, new Map([['left', sole]]));
  assert.deepEqual(prints.map(({from}) => from), [-Infinity, 1.25]);
  assert.deepEqual(prints[0].outline, sole);
  assert.ok(Math.abs(prints[1].outline[0][0] - 0.9) < 1e-9);
  assert.ok(Math.abs(prints[1].outline[2][1] - 0.55) < 1e-9);
  assert.deepEqual(run.plan(1), {foot: 'left', place: [1, 0]});
  assert.equal(run.plan(0), null);
  assert.equal(run.plan(2), null);
  const path = run.swingPath(steps[0]);
  assert.ok(path.length > 70);
  assert.ok(Math.abs(path[0][0] - 0.5) < 1e-3);
  const none = new Run({name: 'run', log: {rows: 3, motion}}, 'A');
  assert.deepEqual(footprintsOf(none, new Map([['left', sole]])), []);
});

test('the plot of ticks shows the control period and the budget, if there is one', () => {
  const marks = (hqp) => timingPlot({summary: {control_dt: 0.001, hqp}}).marks;
  const period = {value: 1000, name: 'one tick'};
  assert.deepEqual(marks({budget_us: 300}), [period, {value: 300, name: 'budget'}]);
  assert.deepEqual(marks({budget_us: 0}), [period]);
  assert.deepEqual(marks(undefined), [period]);
  assert.deepEqual(timingPlot({summary: {}}).marks, []);
});

test('the plot of a joint has the unit and the limit of its kind', () => {
  const robot = {bodies: [{name: 'base'}, {joint: 'knee', type: 'revolute'},
                          {joint: 'lift', type: 'prismatic'}],
                 limits: {knee: {effort: 40}, lift: {effort: 300}}};
  const plot = (joint) => torquePlot({robot}, joint);
  assert.equal(plot('knee').unit, 'N·m');
  assert.equal(plot('lift').unit, 'N');
  assert.equal(plot('knee').hint, 'Limit ±40 N·m.');
  assert.equal(plot('lift').hint, 'Limit ±300 N.');
  assert.deepEqual(plot('lift').marks.map(({value}) => value), [300, -300]);
  assert.equal(torquePlot({}, 'knee').unit, 'N·m');
});
