// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Makes run folders for the browser test: copies of a real run with damaged or
// unusual logs, and a run of a robot that is not a humanoid.
import {once} from 'node:events';
import {copyFileSync, createWriteStream, mkdirSync, readFileSync,
  writeFileSync} from 'node:fs';
import path from 'node:path';

/** Copies a run with another log. Removes the check sum from the summary. */
function withLog(run, folder, log) {
  mkdirSync(folder, {recursive: true});
  copyFileSync(path.join(run, 'robot.json'), path.join(folder, 'robot.json'));
  const {log_sha256: _, ...summary} = summaryOf(run);
  writeFileSync(path.join(folder, 'summary.json'), JSON.stringify(summary));
  writeFileSync(path.join(folder, 'log.csv'), log);
  return folder;
}

const summaryOf = (run) =>
  JSON.parse(readFileSync(path.join(run, 'summary.json'), 'utf8'));

const linesOf = (run) =>
  readFileSync(path.join(run, 'log.csv'), 'utf8').trimEnd().split('\n');

export function emptyRun(run, folder) {
  return withLog(run, folder, linesOf(run)[0] + '\n');
}

/** A run that the user stopped while the robot was standing. */
export function interruptedRun(run, folder) {
  withLog(run, folder, linesOf(run).join('\n') + '\n');
  writeFileSync(path.join(folder, 'summary.json'),
      JSON.stringify({...summaryOf(run), interrupted: true}));
  return folder;
}

/** A run that a full disk stopped, in the middle of a number in row 500. */
export function cutRun(run, folder) {
  const lines = linesOf(run);
  return withLog(run, folder, lines.slice(0, 500).join('\n') + '\n' +
      lines[500].slice(0, 99));
}

export function oneTickRun(run, folder) {
  return withLog(run, folder, linesOf(run).slice(0, 2).join('\n') + '\n');
}

/** A run of ten minutes: the same run repeated at its own rate. */
export async function longRun(run, folder, seconds = 600) {
  const [header, ...rows] = linesOf(run);
  withLog(run, folder, '');
  const tails = rows.map((row) => row.slice(row.indexOf(',')));
  const [first, second] = rows.map((row) => Number(row.split(',', 1)[0]));
  const dt = second - first;
  const out = createWriteStream(path.join(folder, 'log.csv'));
  out.write(header + '\n');
  let block = '';
  for (let tick = 0; tick * dt < seconds; ++tick) {
    block += (tick * dt).toFixed(4) + tails[tick % tails.length] + '\n';
    if (block.length > 1 << 20) {
      if (!out.write(block)) await once(out, 'drain');
      block = '';
    }
  }
  out.end(block);
  await once(out, 'finish');
  return folder;
}

/** A one-legged hopper with each kind of shape, a sliding joint, no limits. */
export function hopperRun(folder) {
  mkdirSync(folder, {recursive: true});
  const still = [0, 0, 0, 1];
  const shape = (body, kind, size, p) =>
    ({body, kind, size, p, quat: still, rgba: [0.4, 0.6, 0.9, 1]});
  writeFileSync(path.join(folder, 'robot.json'), JSON.stringify({
    format: 'poise-robot-1', name: 'hopper', mass: 6,
    bodies: [
      {name: 'trunk', parent: -1},
      {name: 'thigh', parent: 0, joint: 'hip', type: 'revolute',
        axis: [0, 1, 0], p: [0, 0, -0.1], quat: still},
      {name: 'foot', parent: 1, joint: 'spring', type: 'prismatic',
        axis: [0, 0, 1], p: [0, 0, -0.4], quat: still},
    ],
    links: [{name: 'trunk', body: 0, p: [0, 0, 0], quat: still}],
    shapes: [shape(0, 'box', [0.2, 0.3, 0.2], [0, 0, 0]),
      shape(1, 'capsule', [0.03, 0.3, 0], [0, 0, -0.2]),
      shape(1, 'ellipsoid', [0.06, 0.05, 0.1], [0, 0, -0.1]),
      shape(2, 'cylinder', [0.05, 0.04, 0], [0, 0, 0])],
    feet: [{name: 'paw', body: 2, p: [0, 0, -0.02], quat: still,
      half_size: [0.05, 0.05],
      polygon: [[0.05, 0.05], [-0.05, 0.05], [-0.05, -0.05], [0.05, -0.05]]}],
    limits: {},
  }));
  const names = ['time[s]', 'base.x[m]', 'base.y[m]', 'base.z[m]', 'base.qx',
    'base.qy', 'base.qz', 'base.qw', 'com.x[m]', 'com.y[m]', 'com.z[m]',
    'paw.contact', 'paw.mx[Nm]', 'paw.my[Nm]', 'paw.mz[Nm]', 'paw.fx[N]',
    'paw.fy[N]', 'paw.fz[N]', 'q.hip[rad]', 'q.spring[rad]', 'status', 'active'];
  let log = names.join(',') + '\n';
  for (let tick = 0; tick < 800; ++tick) {
    const t = tick / 200;
    const hop = 0.1 * Math.abs(Math.sin(3 * t));
    log += [t, 0.1 * t, 0, 0.52 + hop, 0, 0, 0, 1, 0.1 * t, 0, 0.5 + hop, 1,
      0.1, 0.2, 0, 1, 0, hop < 0.03 ? 120 : 0, 0.3 * Math.sin(3 * t),
      0.05 * Math.cos(3 * t), 'ok', ''].join(',') + '\n';
  }
  writeFileSync(path.join(folder, 'log.csv'), log);
  return folder;
}

/** An STL text of a tetrahedron with corners at 0 and on the axes. */
const TETRAHEDRON = `SOLID tetrahedron
${[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map((corners) =>
    'facet normal 0 0 0\nouter loop\n' + corners.map((corner) =>
      'vertex ' + [1, 2, 3].map((i) => Number(i === corner)).join(' ') + '\n')
        .join('') + 'endloop\nendfacet').join('\n')}
endsolid
`;

/**
 * The hopper, whose trunk and thigh are meshes. The mesh of the trunk was read.
 * That of the thigh is in the packages of the folder, and the report must find
 * it: an ellipsoid and a capsule stand in for it.
 */
export function meshRun(folder) {
  hopperRun(folder);
  const file = path.join(folder, 'robot.json');
  const robot = JSON.parse(readFileSync(file, 'utf8'));
  Object.assign(robot.shapes[0], {kind: 'mesh', size: [0, 0, 0],
    vertices: '0 0 0 2000 0 0 0 2000 0 0 0 2000',
    triangles: '0 2 1 0 1 3 0 3 2 1 2 3', rgba: [0.9, 0.2, 0.1, 1]});
  for (const shape of robot.shapes.slice(1, 3)) shape.stand_in = true;
  const {body, p, quat, rgba} = robot.shapes[1];
  robot.urdf = path.join(folder, 'robot.urdf');
  robot.unread_meshes = [{body, p, quat, rgba,
    file: 'package://legs/thigh.stl', scale: [0.05, 0.05, 0.3]}];
  writeFileSync(file, JSON.stringify(robot));
  const legs = path.join(folder, 'packages/legs');
  mkdirSync(legs, {recursive: true});
  writeFileSync(path.join(legs, 'thigh.stl'), TETRAHEDRON);
  return folder;
}

/**
 * A push map with 16 directions and two rings. One point of each ring has a
 * replay. The points of one ring lie on a circle of the scale.
 */
export function mapPage(template, replay) {
  const rows = [];
  for (const [tasks, part] of [['default', 1],
    ['-cop-yaw+yaw_constant', 0.3]]) {
    for (let i = 0; i < 16; ++i) {
      rows.push({
        direction_deg: 22.5 * i, duration_s: 0.1, tasks, impulse_Ns: 20 * part,
        lipm_Ns: 20, lipm_height_Ns: 14, eta: part,
        ...(i === 2 ? {replay} : {}),
      });
    }
  }
  return template.replace('"POISE-DATA"', () => JSON.stringify(
      {format: 'poise-map-1', robot: 'humanoid', scenario: 'strong_push', rows}));
}
