// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {contactsAt} from './contacts.js';
import {footprintsOf, outlineAt} from './footprints.js';
import {mostAtOnce} from './pushes.js';
import {RobotView} from './robot_view.js';

THREE.Object3D.DEFAULT_UP.set(0, 0, 1);

// Lengths of the arrows of a foot force and of a push that equal the robot's
// weight, relative to the robot's height.
const FOOT_FORCE_LENGTH = 0.4;
const PUSH_LENGTH = 1.15;

const MOST_CORNERS = 64;

const VIEWS = {
  three_quarter: [0.78, -0.62, 0.3],
  front: [1, 0, 0.08],
  side: [0.0, -1, 0.08],
  top: [0.02, 0, 1],
};

const GRID_VERTEX = `
varying vec2 place;
void main() {
  place = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
// Draws grid lines every 0.1 m and 1 m, one pixel wide, fading with distance.
const GRID_FRAGMENT = `
varying vec2 place;
uniform vec3 line;
uniform vec2 center;
float grid(float step) {
  vec2 cell = place / step;
  vec2 away = abs(fract(cell - 0.5) - 0.5) / fwidth(cell);
  return 1.0 - min(min(away.x, away.y), 1.0);
}
void main() {
  float far = distance(place, center);
  float fade = 1.0 - smoothstep(0.5, 4.0, far);
  float fine = 1.0 - smoothstep(0.2, 1.6, far);
  float strength = max(0.34 * grid(1.0) * fade, 0.13 * grid(0.1) * fine);
  gl_FragColor = vec4(line, strength);
}`;

/** Returns a geometry of at most `capacity` points that can change. */
function pointsGeometry(capacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(
      new Float32Array(3 * capacity), 3));
  return geometry;
}

function setPoints(object, points) {
  const {position} = object.geometry.attributes;
  const count = Math.min(points.length, position.count);
  for (let i = 0; i < count; ++i) position.setXYZ(i, ...points[i]);
  position.needsUpdate = true;
  return count;
}

/** An arrow from a point along a vector, m. It can be visible through bodies. */
class Arrow {
  constructor(seenThrough) {
    this.group = new THREE.Group();
    this.material = new THREE.MeshStandardMaterial(
        {roughness: 0.4, emissiveIntensity: 0.35,
         transparent: true, opacity: seenThrough ? 0.85 : 1,
         depthTest: !seenThrough});
    this.shaft = new THREE.Mesh(
        new THREE.CylinderGeometry(1, 1, 1, 20).translate(0, 0.5, 0),
        this.material);
    this.head = new THREE.Mesh(
        new THREE.ConeGeometry(2.6, 6, 24).translate(0, -3, 0), this.material);
    this.setThickness(0.01);
    this.shaft.renderOrder = this.head.renderOrder = seenThrough ? 3 : 0;
    this.group.add(this.shaft, this.head);
    this.group.visible = false;
  }

  setThickness(radius) {
    this.radius = radius;
  }

  set(from, vector) {
    const length = vector.length();
    this.group.visible = length > 0.01;
    if (!this.group.visible) return;
    const direction = vector.clone().divideScalar(length);
    this.group.position.copy(from);
    this.group.quaternion.setFromUnitVectors(
        new THREE.Vector3(0, 1, 0), direction);
    const head = Math.min(6 * this.radius, 0.6 * length);
    this.head.scale.setScalar(head / 6);
    this.head.position.set(0, length, 0);
    this.shaft.scale.set(this.radius, length - 0.9 * head, this.radius);
  }
}

/** The 3D replay of a run, in an element of the page. */
export class Stage {
  #listeners = [];

  constructor(element, run, palette) {
    this.element = element;
    this.run = run;
    this.renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.canvas = this.renderer.domElement;
    this.canvas.setAttribute('aria-label', `3D replay of ${run.name}`);
    element.prepend(this.canvas);

    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.05, 60);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 20;
    this.controls.maxPolarAngle = 0.53 * Math.PI;
    this.controls.addEventListener('change', () => {
      for (const listener of this.#listeners) listener(this);
    });

    this.robot = run.robot ? new RobotView(run.robot) : null;
    if (this.robot) this.scene.add(this.robot.root);
    this.#addLight();
    this.#addGround();
    this.#addMarks();
    this.footprints = [];
    this.update(run.start);
    this.#addSteps();
    this.setPalette(palette);
    this.update(run.start);
    this.#frameRobot();
    this.setView('three_quarter');
    new ResizeObserver(() => this.resize()).observe(element);
  }

  #addLight() {
    this.sky = new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.5);
    this.sun = new THREE.DirectionalLight(0xffffff, 2.1);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 4;
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    this.fill = new THREE.DirectionalLight(0xdfe8ff, 0.7);
    this.scene.add(this.sky, this.sun, this.sun.target, this.fill);
  }

  #addGround() {
    const plane = new THREE.PlaneGeometry(16, 16);
    this.shadow = new THREE.Mesh(plane, new THREE.ShadowMaterial({opacity: 0.25}));
    this.shadow.receiveShadow = true;
    this.grid = new THREE.Mesh(plane, new THREE.ShaderMaterial({
      vertexShader: GRID_VERTEX,
      fragmentShader: GRID_FRAGMENT,
      uniforms: {line: {value: new THREE.Color()},
                 center: {value: new THREE.Vector2()}},
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
    }));
    this.grid.position.z = 0.0005;
    this.scene.add(this.shadow, this.grid);
  }

  // The marks on the ground are visible through the feet on them.
  #addMarks() {
    const flat = (geometry, opacity = 1) => {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({
        transparent: true, opacity, depthTest: false, side: THREE.DoubleSide,
      }));
      mesh.renderOrder = 5;
      mesh.position.z = 0.002;
      this.scene.add(mesh);
      return mesh;
    };
    this.supportFill = new THREE.Mesh(
        pointsGeometry(MOST_CORNERS),
        new THREE.MeshBasicMaterial(
            {transparent: true, opacity: 0.16, depthWrite: false,
             side: THREE.DoubleSide}));
    this.supportEdge = new THREE.LineLoop(
        pointsGeometry(MOST_CORNERS),
        new THREE.LineBasicMaterial({transparent: true, depthTest: false,
                                     opacity: 0.9}));
    const fan = [];
    for (let i = 2; i < MOST_CORNERS; ++i) fan.push(0, i - 1, i);
    this.supportFill.geometry.setIndex(fan);
    // Their points move, so a bound of them would be out of date and hide them.
    this.supportFill.frustumCulled = this.supportEdge.frustumCulled = false;
    this.scene.add(this.supportFill, this.supportEdge);
    this.comRing = flat(new THREE.RingGeometry(0.013, 0.019, 32));
    this.comBall = flat(new THREE.SphereGeometry(0.018, 24, 16), 0.9);
    this.copDot = flat(new THREE.CircleGeometry(0.014, 32));
    this.captureMark = flat(new THREE.RingGeometry(0.011, 0.02, 4, 1));
    this.plumb = new THREE.Line(
        pointsGeometry(2),
        new THREE.LineBasicMaterial({transparent: true, opacity: 0.6,
                                     depthTest: false}));
    this.plumb.renderOrder = 4;
    this.plumb.frustumCulled = false;
    this.scene.add(this.plumb);
    this.footArrows = (this.robot?.feet ?? []).map(() => new Arrow(true));
    this.pushes = [];  // The drawn pushes: {newtons, tail}.
    const most = Math.max(1, mostAtOnce(this.run.summary.pushes ?? []));
    this.pushArrows = Array.from({length: most}, () => new Arrow(false));
    for (const arrow of [...this.footArrows, ...this.pushArrows]) {
      this.scene.add(arrow.group);
    }
  }

  // Adds the footprints, the paths of the feet between them, and the planned
  // place of the foot in the air. The robot is in its pose of the start.
  #addSteps() {
    this.soles = new Map((this.contacts?.feet ?? []).map(
        (foot) => [foot.name, foot.sole]));
    this.footprints = footprintsOf(this.run, this.soles);
    const line = (type, points, opacity) => {
      const shape = new type(
          pointsGeometry(Math.max(2, points.length)),
          new THREE.LineBasicMaterial({transparent: true, opacity}));
      shape.geometry.setDrawRange(0, setPoints(shape, points));
      shape.frustumCulled = false;
      this.scene.add(shape);
      return shape;
    };
    const onGround = (outline) => outline.map(([x, y]) => [x, y, 0.0015]);
    this.prints = this.footprints.map(({outline, from}) => (
      {from, shape: line(THREE.LineLoop, onGround(outline), 0.45)}));
    this.swings = this.run.steps.map((step) => (
      {from: step.at, swing: step.swing_s,
       shape: line(THREE.Line, this.run.swingPath(step), 0.8)}));
    this.planned = line(THREE.LineLoop,
                        Array.from({length: MOST_CORNERS}, () => [0, 0, 0]), 1);
  }

  #drawSteps(time) {
    if (!this.planned) return;
    for (const {from, shape} of this.prints) shape.visible = from <= time;
    for (const {from, swing, shape} of this.swings) {
      shape.visible = from <= time;
      const {count} = shape.geometry.attributes.position;
      const share = Math.min(1, (time - from) / swing);
      shape.geometry.setDrawRange(0, Math.max(2, Math.ceil(share * count)));
    }
    const plan = this.run.plan(time);
    this.planned.visible = plan !== null;
    if (!plan) return;
    const outline = outlineAt(this.soles.get(plan.foot) ?? [], plan.place);
    this.planned.geometry.setDrawRange(
        0, setPoints(this.planned, outline.map(([x, y]) => [x, y, 0.002])));
  }

  setPalette(palette) {
    const color = (name) => new THREE.Color(palette[name]);
    this.grid.material.uniforms.line.value = color('ink');
    this.shadow.material.opacity = palette.dark ? 0.5 : 0.2;
    this.sky.intensity = palette.dark ? 1.1 : 1.5;
    this.supportFill.material.color = color('support');
    this.supportEdge.material.color = color('support');
    this.comRing.material.color = color('com');
    this.comBall.material.color = color('com');
    this.plumb.material.color = color('com');
    this.copDot.material.color = color('cop');
    this.captureMark.material.color = color('capture');
    this.planned.material.color = color('capture');
    for (const {shape} of this.prints) shape.material.color = color('ink');
    for (const {shape} of this.swings) shape.material.color = color('com');
    for (const arrow of this.footArrows) {
      arrow.material.color = arrow.material.emissive = color('force');
    }
    for (const arrow of this.pushArrows) {
      arrow.material.color = arrow.material.emissive = color('push');
    }
    this.dirty = true;
  }

  // Computes the robot's size and middle at the start, for the camera.
  #frameRobot() {
    const box = new THREE.Box3(new THREE.Vector3(-0.3, -0.3, 0),
                               new THREE.Vector3(0.3, 0.3, 1));
    if (this.robot) {
      box.setFromObject(this.robot.root);
      // Without a log, puts the robot on the ground.
      if (!this.run.motion.rows) {
        this.robot.root.position.z = -box.min.z;
        box.translate(this.robot.root.position);
        this.update(this.run.start);
      }
    }
    this.middle = box.getCenter(new THREE.Vector3());
    this.height = Math.max(0.2, box.max.z, box.max.x - box.min.x,
                           box.max.y - box.min.y);
    this.followed = this.middle.clone();
    const size = this.height;
    this.sun.shadow.camera.left = this.sun.shadow.camera.bottom = -1.3 * size;
    this.sun.shadow.camera.right = this.sun.shadow.camera.top = 1.3 * size;
    this.sun.shadow.camera.near = 0.1;
    this.sun.shadow.camera.far = 10 * size;
    const scale = size / 1.5;
    for (const arrow of this.pushArrows) arrow.setThickness(0.013 * scale);
    for (const arrow of this.footArrows) arrow.setThickness(0.008 * scale);
    for (const mark of [this.comRing, this.comBall, this.copDot,
                        this.captureMark]) {
      mark.scale.setScalar(Math.min(1.4, Math.max(0.5, scale)));
    }
  }

  /** Moves the camera to one of VIEWS. */
  setView(name) {
    const direction = new THREE.Vector3(...VIEWS[name]).normalize();
    this.controls.target.copy(this.followed);
    this.controls.target.z = 0.5 * this.height;
    this.camera.position.copy(this.controls.target)
        .addScaledVector(direction, 2.55 * this.height);
    this.controls.update();
    this.dirty = true;
  }

  /** Registers a callback for camera moves by the user. */
  onCamera(listener) {
    this.#listeners.push(listener);
  }

  /** Copies the camera of another stage, relative to the robot. */
  copyCamera(other) {
    const offset = other.camera.position.clone().sub(other.controls.target);
    const target = other.controls.target.clone().sub(other.followed);
    this.controls.target.copy(this.followed).add(target);
    this.camera.position.copy(this.controls.target).add(offset);
    this.camera.lookAt(this.controls.target);
    this.dirty = true;
  }

  update(time) {
    this.dirty = true;
    if (!this.robot) return;
    const {run} = this;
    this.robot.pose(run, Math.min(time, run.end));
    this.#follow();
    const com = run.vector('com.', time);
    const contacts = contactsAt(run, this.robot, time);
    const capture = run.capturePoint(time);
    this.contacts = {...contacts, com, capture};
    this.#drawSupport(contacts.support);
    this.#drawSteps(time);
    this.comRing.position.set(com[0], com[1], 0.002);
    this.comBall.position.set(...com);
    setPoints(this.plumb, [com, [com[0], com[1], 0]]);
    this.copDot.visible = contacts.cop !== null;
    if (contacts.cop) this.copDot.position.set(...contacts.cop, 0.002);
    this.captureMark.position.set(...capture, 0.002);
    contacts.feet.forEach((foot, i) => {
      this.footArrows[i].set(
          foot.point ?? new THREE.Vector3(),
          foot.force.multiplyScalar(
              foot.point ? FOOT_FORCE_LENGTH * this.#lengthPerNewton : 0));
    });
    this.#drawPushes(time, com);
  }

  // Height of the robot divided by its weight, m/N.
  get #lengthPerNewton() {
    return (this.height ?? 1) / ((this.run.robot.mass || 1) * 9.81);
  }

  // The camera follows when the robot walks away, but not when it sways.
  #follow() {
    const at = this.robot.bodies[0].position;
    if (!this.followed) return;
    const away = new THREE.Vector3(at.x - this.followed.x,
                                   at.y - this.followed.y, 0);
    const free = 0.6 * this.height;
    if (away.length() > free) {
      away.setLength(away.length() - free);
      this.followed.add(away);
      this.controls.target.add(away);
      this.camera.position.add(away);
    }
    this.grid.material.uniforms.center.value.set(at.x, at.y);
    this.sun.position.set(at.x + 1.4 * this.height, at.y - 1.1 * this.height,
                          3.2 * this.height);
    this.sun.target.position.set(at.x, at.y, 0.4 * this.height);
    this.fill.position.set(at.x - 2, at.y + 2, 1.5);
  }

  #drawSupport(polygon) {
    const shown = polygon.length > 2;
    this.supportFill.visible = this.supportEdge.visible = shown;
    if (!shown) return;
    const points = polygon.map(([x, y]) => [x, y, 0.001]);
    const count = setPoints(this.supportEdge, points);
    setPoints(this.supportFill, points);
    this.supportEdge.geometry.setDrawRange(0, count);
    this.supportFill.geometry.setDrawRange(0, 3 * (count - 2));
  }

  /** Draws an arrow for each push that acts, at the point where it acts. */
  #drawPushes(time, com) {
    const acting = this.run.pushesAt(time);
    this.pushes = [];
    this.pushArrows.forEach((arrow, i) => {
      if (i < acting.length) {
        this.pushes.push(this.#drawPush(acting[i], com, arrow));
      } else {
        arrow.set(new THREE.Vector3(), new THREE.Vector3());
      }
    });
  }

  #drawPush({force: along, frame, body: index, point: at}, com, arrow) {
    const force = new THREE.Vector3(...along);
    const body = this.robot.bodies[index];
    const point = body && at ?
        new THREE.Vector3(...at).applyMatrix4(body.matrixWorld) :
        new THREE.Vector3(...com);
    if (body && frame === 'body') {
      force.applyQuaternion(body.getWorldQuaternion(new THREE.Quaternion()));
    }
    // The arrow is outside the body and points at the surface that is pushed.
    const vector = force.clone().multiplyScalar(
        PUSH_LENGTH * this.#lengthPerNewton);
    vector.clampLength(0, 1.2 * this.height);
    const outside = vector.clone().setLength(0.06 * this.height);
    const tail = point.clone().sub(vector).sub(outside);
    arrow.set(tail, vector);
    return {newtons: force.length(), tail};
  }

  /** Returns the position of a world point on the canvas, in CSS pixels. */
  project(point) {
    const on = point.clone().project(this.camera);
    return [(on.x + 1) / 2 * this.element.clientWidth,
            (1 - on.y) / 2 * this.element.clientHeight];
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.element;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // Tall canvases need a wider angle to show the arms.
    this.camera.fov = width < 0.75 * height ?
        2 * Math.atan(Math.tan(Math.PI / 12) * 0.75 * height / width) * 180 /
            Math.PI :
        30;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  render() {
    if (!this.dirty) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
  }
}
