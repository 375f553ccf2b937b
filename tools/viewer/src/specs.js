// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The plots of a run. Each entry names channels of a run; plots.js draws them.

const AXIS_COLORS = {x: 'c1', y: 'c2', z: 'c3'};
const RUN_COLORS = ['c1', 'c2'];

const vectorLines = (prefix, axes) => axes.map(
    (axis) => ({name: axis, channel: prefix + axis, color: AXIS_COLORS[axis]}));

function footLines(run, part) {
  const feet = run.signals.names.filter((name) => name.endsWith('.contact'))
      .map((name) => name.slice(0, -'.contact'.length));
  return feet.map((foot, i) => ({
    name: foot.replaceAll('_', ' '),
    channel: `${foot}.${part}`,
    color: ['c1', 'c2', 'c3', 'c4'][i % 4],
  }));
}

/** Returns marks at the soles' extent in the mid-feet frame: {x, y}. */
function soleEdges(run) {
  const edges = run.soleEdges;
  const marks = (axis) => edges ? [
    {value: 1e3 * edges[axis][0], name: 'edge of the soles'},
    {value: 1e3 * edges[axis][1], name: 'edge of the soles'},
  ] : [];
  // The combined box of equation (12), if its task is on.
  const half = run.summary.tasks?.with?.includes('zmp') ? 100 : null;
  const box = half ? [{value: half, name: 'zmp limit', always: true},
                      {value: -half, name: 'zmp limit', always: true}] : [];
  return {x: marks('x'), y: [...marks('y'), ...box]};
}

/** Returns the plots of the capture point, for a run with steps. */
function captureSpecs() {
  return ['y', 'x'].map((axis) => ({
    title: `Capture point in ${axis}`, unit: 'm', least: 0.02,
    hint: 'Divergent component of motion ξ of the center of mass, with the ' +
        'angular momentum given back.',
    lines: [{name: 'ξ', channel: `xi.${axis}`, color: 'c4'},
            {name: 'CoM', channel: `com.${axis}`, color: 'c2'}],
  }));
}

/** Returns the plots of a run, the most important ones first. */
export function plotsOf(run) {
  const edges = soleEdges(run);
  return [
    {title: 'CoM error', unit: 'mm', scale: 1e3, least: 2,
     hint: 'Center of mass minus its reference.',
     lines: vectorLines('com_error.', ['x', 'y'])},
    {title: 'CoP in y', unit: 'mm', scale: 1e3, least: 20, marks: edges.y,
     hint: 'Center of pressure (ZMP) of both feet, left of their middle.',
     lines: vectorLines('cop.', ['y'])},
    {title: 'CoP in x', unit: 'mm', scale: 1e3, least: 20, marks: edges.x,
     hint: 'Center of pressure (ZMP) of both feet, in front of their middle.',
     lines: vectorLines('cop.', ['x'])},
    {title: 'Foot load', unit: 'N', floor: 0, least: 20,
     hint: 'Normal force of the ground on each foot.',
     lines: footLines(run, 'fz')},
    {title: 'Foot force in y', unit: 'N', least: 10,
     hint: 'Friction force to the left, in the sole\'s axes.',
     lines: footLines(run, 'fy')},
    {title: 'Foot force in x', unit: 'N', least: 10,
     hint: 'Friction force forward, in the sole\'s axes.',
     lines: footLines(run, 'fx')},
    {title: 'CoM in y', unit: 'm', least: 0.002,
     hint: 'Center of mass and its reference.',
     lines: [
       {name: 'CoM', channel: 'com.y', color: 'c2'},
       {name: 'reference', channel: 'com_ref.y', color: 'faint', dash: [5, 4]},
     ]},
    {title: 'CoM in x', unit: 'm', least: 0.002,
     lines: [
       {name: 'CoM', channel: 'com.x', color: 'c1'},
       {name: 'reference', channel: 'com_ref.x', color: 'faint', dash: [5, 4]},
     ]},
    ...(run.steps.length ? captureSpecs() : []),
    {title: 'Foot tilt', unit: 'mrad', scale: 1e3, floor: 0, least: 2,
     hint: 'Above 100 mrad the robot has not recovered.',
     marks: [{value: 100, name: 'limit'}],
     lines: footLines(run, 'tilt')},
    {title: 'Foot slide', unit: 'mm', scale: 1e3, floor: 0, least: 1,
     hint: 'Above 30 mm the robot has not recovered.',
     marks: [{value: 30, name: 'limit'}],
     lines: footLines(run, 'slide')},
    {title: 'Base tilt', unit: '°', scale: 180 / Math.PI, floor: 0, least: 2,
     hint: 'Above 60° the robot has fallen.',
     marks: [{value: 60, name: 'fallen'}],
     lines: [{name: 'tilt', channel: 'base.tilt', color: 'c1'}]},
    {title: 'Base height', unit: 'm', least: 0.01,
     lines: [{name: 'height', channel: 'base.z', color: 'c1'}]},
  ];
}

/**
 * Returns the plot of the time of each tick, with the control period and the limit of the
 * solver's time.
 */
export function timingPlot(run) {
  const period = 1e6 * (run.summary.control_dt ?? NaN);
  const budget = run.summary.hqp?.budget_us;
  return {
    title: 'Control tick', unit: 'µs', floor: 0, least: 50,
    hint: 'Time to compute the torques.' +
        (budget > 0 ? ' The budget is for the solver alone.' : ''),
    marks: [
      ...(Number.isFinite(period) ? [{value: period, name: 'one tick'}] : []),
      ...(budget > 0 ? [{value: budget, name: 'budget'}] : []),
    ],
    lines: [{name: 'computed in', channel: 'us', color: 'c3', width: 1.1}],
  };
}

/** Returns the plot of a joint's torque, or of a slider's force, with its limits. */
export function torquePlot(run, joint) {
  const effort = run.robot?.limits?.[joint]?.effort;
  const isSlider = run.robot?.bodies?.some(
      (body) => body.joint === joint && body.type === 'prismatic');
  const unit = isSlider ? 'N' : 'N·m';
  return {
    title: isSlider ? 'Force' : 'Torque', unit, least: 2,
    hint: effort ? `Limit ±${effort} ${unit}.` : '',
    marks: effort ? [{value: effort, name: 'limit'},
                     {value: -effort, name: 'limit'}] : [],
    lines: [{name: joint, channel: `tau.${joint}`, color: 'c1'}],
  };
}

// Returns the lines of a plot with their values. Lines that the log does not
// have are left out.
function filled(lines, table) {
  return lines.filter((line) => table.has(line.channel) && table.rows > 0)
      .map((line) => ({...line, time: table.time,
                       values: table.values(line.channel)}));
}

/**
 * Returns a plot with its values for one run. For two runs, each line becomes a
 * plot of its own, in which the color shows the run.
 */
export function fillPlots(runs, specOf, tableOf) {
  const specs = runs.map((run) => specOf(run));
  if (runs.length === 1) {
    const [spec] = specs;
    return [{...spec, lines: filled(spec.lines, tableOf(runs[0]))}];
  }
  const [first] = specs;
  // A reference is drawn once for both runs.
  const own = first.lines.filter((line) => !line.dash);
  return own.map((line) => {
    const lines = runs.flatMap((run, i) => {
      const same = specs[i].lines.filter(
          ({channel}) => channel === line.channel);
      return filled(same.map((each) => ({
        ...each, color: RUN_COLORS[i], name: run.label,
      })), tableOf(run));
    });
    const references = filled(first.lines.filter(({dash}) => dash),
                              tableOf(runs[0]));
    const names = own.length > 1 ? `, ${line.name}` : '';
    const marks = specs.flatMap(({marks = []}) => marks).filter(
        (mark, i, all) => all.findIndex(({value, name}) =>
          name === mark.name && Math.abs(value - mark.value) < 1e-6) === i);
    return {...first, title: first.title + names, marks,
            lines: [...lines, ...references]};
  });
}
