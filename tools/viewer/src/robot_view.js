// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import * as THREE from 'three';

// Cylinder axes are along y in three.js, along z in URDF.
const Y_TO_Z = new THREE.Quaternion().setFromAxisAngle(
    new THREE.Vector3(1, 0, 0), Math.PI / 2);

const numbersIn = (text) => text === '' ? [] : text.split(' ').map(Number);

// Vertices are in 0.1 mm. Each triangle has its own normal, because a mesh is
// too coarse for smooth shading.
function meshGeometry({vertices, triangles}) {
  const shared = new THREE.BufferGeometry();
  const meters = numbersIn(vertices).map((length) => 1e-4 * length);
  shared.setAttribute('position', new THREE.Float32BufferAttribute(meters, 3));
  shared.setIndex(numbersIn(triangles));
  const geometry = shared.toNonIndexed();
  geometry.computeVertexNormals();
  return geometry;
}

function geometryOf(shape) {
  const {kind, size} = shape;
  if (kind === 'mesh') return meshGeometry(shape);
  if (kind === 'box') return new THREE.BoxGeometry(...size);
  if (kind === 'ellipsoid') {
    return new THREE.SphereGeometry(1, 32, 20).scale(...size);
  }
  const [radius, length] = size;
  const geometry = kind === 'capsule' ?
      new THREE.CapsuleGeometry(radius, length, 8, 20) :
      new THREE.CylinderGeometry(radius, radius, length, 36);
  return geometry.applyQuaternion(Y_TO_Z);
}

function place(object, {p, quat}) {
  object.position.set(...p);
  object.quaternion.set(...quat);
  return object;
}

/**
 * A robot of robot.json in 3D: one group per body. The channels base.* and
 * q.JOINT of a run move the groups.
 */
export class RobotView {
  #joints = [];
  #materials = new Map();

  constructor(robot) {
    this.root = new THREE.Group();
    this.bodies = [];
    for (const body of robot.bodies) this.#addBody(body);
    for (const shape of robot.shapes) {
      const mesh = new THREE.Mesh(geometryOf(shape), this.#material(shape));
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      this.bodies[shape.body].add(place(mesh, shape));
    }
    this.feet = robot.feet.map((foot) => ({...foot, frame: this.#frame(foot)}));
  }

  #addBody(body) {
    const moved = new THREE.Group();
    this.bodies.push(moved);
    if (body.parent < 0) {
      this.root.add(moved);
      return;
    }
    const fixed = place(new THREE.Group(), body);
    fixed.add(moved);
    this.bodies[body.parent].add(fixed);
    this.#joints.push({
      channel: `q.${body.joint}`,
      moved,
      axis: new THREE.Vector3(...body.axis).normalize(),
      slides: body.type === 'prismatic',
    });
  }

  #frame(fixed) {
    const frame = place(new THREE.Object3D(), fixed);
    this.bodies[fixed.body].add(frame);
    return frame;
  }

  #material({kind, rgba}) {
    const key = `${kind === 'mesh'} ${rgba}`;
    if (!this.#materials.has(key)) {
      const [r, g, b, a] = rgba;
      this.#materials.set(key, new THREE.MeshStandardMaterial({
        color: new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace),
        roughness: 0.55,
        metalness: 0.05,
        transparent: a < 1,
        opacity: a,
        // Meshes have holes, and triangles in the wrong order.
        side: kind === 'mesh' ? THREE.DoubleSide : THREE.FrontSide,
      }));
    }
    return this.#materials.get(key);
  }

  /** Sets the posture of a run at a time, interpolated between its rows. */
  pose(run, time) {
    const {motion} = run;
    const [x, y, z] = run.vector('base.', time);
    const base = this.bodies[0];
    base.position.set(x, y, z);
    if (motion.rows > 0 && motion.has('base.qw')) {
      const {i, j, part} = motion.between(time);
      const at = (row) => new THREE.Quaternion(
          ...['qx', 'qy', 'qz', 'qw'].map((c) => motion.values(`base.${c}`)[row]));
      base.quaternion.slerpQuaternions(at(i), at(j), part).normalize();
    }
    for (const joint of this.#joints) {
      const q = motion.at(joint.channel, time, 0);
      if (joint.slides) joint.moved.position.copy(joint.axis).multiplyScalar(q);
      else joint.moved.quaternion.setFromAxisAngle(joint.axis, q);
    }
    this.root.updateMatrixWorld(true);
  }
}
