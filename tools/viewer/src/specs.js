// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// What is plotted: each entry names channels of a run, nothing is drawn here.

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

/** The soles' common extent in the mid-feet frame at the start: {x, y}. */
function soleEdges(run) {
  const edges = run.soleEdges;
  const marks = (axis) => edges ? [
    {value: 1e3 * edges[axis][0], name: 'edge of the soles'},
    {value: 1e3 * edges[axis][1], name: 'edge of the soles'},
  ] : [];
  // The combined box of equation (12), where it is on.
  const half = run.summary.tasks?.with?.includes('zmp') ? 100 : null;
  const box = half ? [{value: half, name: 'zmp limit', always: true},
                      {value: -half, name: 'zmp limit', always: true}] : [];
  return {x: marks('x'), y: [...marks('y'), ...box]};
}

/** The plots of a run, in the order in which one reads them. */
export function plotsOf(run) {
  const edges = soleEdges(run);
  return [
    {title: 'CoM error', unit: 'mm', scale: 1e3, least: 2,
     hint: 'Center of mass minus its reference.',
     lines: vectorLines('com_error.', ['x', 'y'])},
    {title: 'CoP in y', unit: 'mm', scale: 1e3, least: 20, marks: edges.y,
     hint: 'Center of pressure (ZMP) of both feet, to the left, from their middle.',
     lines: vectorLines('cop.', ['y'])},
    {title: 'CoP in x', unit: 'mm', scale: 1e3, least: 20, marks: edges.x,
     hint: 'The same, forward.',
     lines: vectorLines('cop.', ['x'])},
    {title: 'Foot load', unit: 'N', floor: 0, least: 20,
     hint: 'Normal force of the ground.',
     lines: footLines(run, 'fz')},
    {title: 'Foot force in y', unit: 'N', least: 10,
     hint: 'Friction, to the left, in the sole\'s axes.',
     lines: footLines(run, 'fy')},
    {title: 'Foot force in x', unit: 'N', least: 10,
     hint: 'The same, forward.',
     lines: footLines(run, 'fx')},
    {title: 'CoM in y', unit: 'm', least: 0.002,
     hint: 'With its reference.',
     lines: [
       {name: 'CoM', channel: 'com.y', color: 'c2'},
       {name: 'reference', channel: 'com_ref.y', color: 'faint', dash: [5, 4]},
     ]},
    {title: 'CoM in x', unit: 'm', least: 0.002,
     lines: [
       {name: 'CoM', channel: 'com.x', color: 'c1'},
       {name: 'reference', channel: 'com_ref.x', color: 'faint', dash: [5, 4]},
     ]},
    {title: 'Foot tilt', unit: 'mrad', scale: 1e3, floor: 0, least: 2,
     hint: 'Over 100 mrad is not recovered.',
     marks: [{value: 100, name: 'limit'}],
     lines: footLines(run, 'tilt')},
    {title: 'Foot slide', unit: 'mm', scale: 1e3, floor: 0, least: 1,
     hint: 'Over 30 mm is not recovered.',
     marks: [{value: 30, name: 'limit'}],
     lines: footLines(run, 'slide')},
    {title: 'Base tilt', unit: '°', scale: 180 / Math.PI, floor: 0, least: 2,
     hint: 'Over 60° is a fall.',
     marks: [{value: 60, name: 'fallen'}],
     lines: [{name: 'tilt', channel: 'base.tilt', color: 'c1'}]},
    {title: 'Base height', unit: 'm', least: 0.01,
     lines: [{name: 'height', channel: 'base.z', color: 'c1'}]},
  ];
}

/** The time that each tick took, against the time it has. */
export function timingPlot(run) {
  const period = 1e6 * (run.summary.control_dt ?? NaN);
  return {
    title: 'Control tick', unit: 'µs', floor: 0, least: 50,
    hint: 'Time to compute the torques.',
    marks: Number.isFinite(period) ? [{value: period, name: 'one tick'}] : [],
    lines: [{name: 'computed in', channel: 'us', color: 'c3', width: 1.1}],
  };
}

/** A joint's torque with its limits. */
export function torquePlot(run, joint) {
  const effort = run.robot?.limits?.[joint]?.effort;
  return {
    title: 'Torque', unit: 'N·m', least: 2,
    hint: effort ? `Limit ±${effort} N·m.` : '',
    marks: effort ? [{value: effort, name: 'limit'},
                     {value: -effort, name: 'limit'}] : [],
    lines: [{name: joint, channel: `tau.${joint}`, color: 'c1'}],
  };
}

// The lines of a plot with their values; those the log does not have fall out.
function filled(lines, table) {
  return lines.filter((line) => table.has(line.channel) && table.rows > 0)
      .map((line) => ({...line, time: table.time,
                       values: table.values(line.channel)}));
}

/**
 * A plot's lines for one run; for two, each line becomes a plot in which the
 * runs differ by color.
 */
export function fillPlots(runs, specOf, tableOf) {
  const specs = runs.map((run) => specOf(run));
  if (runs.length === 1) {
    const [spec] = specs;
    return [{...spec, lines: filled(spec.lines, tableOf(runs[0]))}];
  }
  const [first] = specs;
  // A reference is drawn once beside both.
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
