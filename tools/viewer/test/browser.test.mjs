// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Tests the pages in a real browser. Environment variables:
//     POISE_REPORT   the program report
//     POISE_STANDS   a run that recovers from a push
//     POISE_FALLS    a run that falls
//     POISE_OUT      folder for pages and screenshots
//     CHROMIUM       the browser [/usr/bin/chromium]
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import test, {after, before} from 'node:test';
import {fileURLToPath} from 'node:url';
import {chromium} from 'playwright-core';
import {cutRun, emptyRun, hopperRun, interruptedRun, longRun, mapPage,
  meshRun, oneTickRun} from './runs.mjs';

const {POISE_REPORT, POISE_STANDS, POISE_FALLS, POISE_OUT} = process.env;
const dist = fileURLToPath(new URL('../dist/', import.meta.url));
const out = (name) => path.join(POISE_OUT, name);

// Drawing is slow on a busy machine. Bazel's time limit stops a hanging test.
const PATIENCE = 600e3;

let browser;
const pages = {};

before(async () => {
  mkdirSync(POISE_OUT, {recursive: true});
  const report = (name, ...runs) => {
    pages[name] = out(`${name}.html`);
    execFileSync(POISE_REPORT, [...runs, '--out', pages[name]]);
  };
  const runs = (name) => out(`runs/${name}`);
  report('stands', POISE_STANDS);
  report('falls', POISE_FALLS);
  report('compare', POISE_FALLS, POISE_STANDS);
  report('empty', emptyRun(POISE_STANDS, runs('empty')));
  report('interrupted', interruptedRun(POISE_STANDS, runs('interrupted')));
  report('cut', cutRun(POISE_STANDS, runs('cut')));
  report('one_tick', oneTickRun(POISE_STANDS, runs('one_tick')));
  report('hopper', hopperRun(runs('hopper')));
  report('hopper_and_humanoid', runs('hopper'), POISE_STANDS);
  report('meshes', meshRun(runs('meshes')),
      '--package-path', runs('meshes/packages'));
  report('long', await longRun(POISE_STANDS, runs('long')));
  rmSync(runs('long'), {recursive: true});
  pages.map = out('map.html');
  writeFileSync(pages.map, mapPage(
      readFileSync(path.join(dist, 'map.html'), 'utf8'), 'compare.html'));
  browser = await chromium.launch({
    timeout: PATIENCE,
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--disable-background-networking'],
  });
});

after(() => browser?.close());

/** Opens a page. An error in it or a request to the network fails the test. */
async function withPage(name, options, act) {
  const page = await browser.newPage(
      {viewport: {width: 1440, height: 900}, ...options});
  page.setDefaultTimeout(PATIENCE);
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  page.on('request', (request) => {
    if (!/^(file|data|blob|about):/.test(request.url())) {
      errors.push(`the page requested ${request.url()} from the network`);
    }
  });
  try {
    await page.goto(`file://${pages[name]}`);
    await page.waitForFunction(() => window.poise);
    await drawn(page);
    await act(page);
    assert.deepEqual(errors, []);
  } finally {
    await page.close();
  }
}

/** Waits until all changes are on the screen. */
const drawn = (page, frames = 3) => page.evaluate((count) =>
  new Promise((resolve) => {
    const next = () => (count-- > 0 ? requestAnimationFrame(next) : resolve());
    next();
  }), frames);

const seek = (page, time) =>
  page.evaluate((t) => window.poise.clock.seek(t), time);

/** Returns the poses of each robot's base and last body in the world. */
const whereRobots = (page) => page.evaluate(() =>
  window.poise.stages.map(({stage}) => [
    ...stage.robot.bodies[0].matrixWorld.elements,
    ...stage.robot.bodies.at(-1).matrixWorld.elements]));

/** Returns the number of colors that a stage shows, from its canvas. */
const colorsOf = (page, index = 0) => page.evaluate((i) => {
  const {stage} = window.poise.stages[i];
  stage.dirty = true;
  stage.render();
  const copy = document.createElement('canvas');
  [copy.width, copy.height] = [200, 200];
  const context = copy.getContext('2d');
  context.drawImage(stage.canvas, 0, 0, 200, 200);
  const {data} = context.getImageData(0, 0, 200, 200);
  const colors = new Set();
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3] > 200) {
      colors.add(data[k] >> 3 << 10 | data[k + 1] >> 3 << 5 | data[k + 2] >> 3);
    }
  }
  return colors.size;
}, index);

const cursors = (page) => page.$$eval('.time-cursor', (all) => all.map(
    (each) => each.getBoundingClientRect().x));

test('a report of ten seconds is one file of less than 5 MB', () => {
  const {size} = statSync(pages.stands);
  assert.ok(size < 5e6, String(size));
});

test('a run is shown with numbers, plots and a visible robot',
  () => withPage('stands', {}, async (page) => {
    assert.equal(await page.locator('.verdict').textContent(), 'Recovered');
    assert.ok(await page.locator('.tile').count() >= 8);
    assert.ok(await page.locator('.plot .u-over').count() >= 8);
    assert.ok(await page.locator('.strip ol li').count() > 3);
    assert.ok(await colorsOf(page) > 60);
    await seek(page, 1.1);
    await drawn(page);
    await page.screenshot({path: out('stands.png')});
    await page.screenshot({path: out('stands_all.png'), fullPage: true});
  }));

test('play moves the robot, and pause stops it',
  () => withPage('stands', {}, async (page) => {
    await seek(page, 0.9);
    const start = await whereRobots(page);
    await page.getByLabel('Play', {exact: true}).click();
    await page.waitForFunction(() => window.poise.clock.time > 0.95);
    await page.getByLabel('Pause', {exact: true}).click();
    const end = await whereRobots(page);
    assert.notDeepEqual(end, start);
    await drawn(page, 20);
    assert.deepEqual(await whereRobots(page), end);
  }));

test('the keyboard plays and steps',
  () => withPage('stands', {}, async (page) => {
    await seek(page, 1);
    await page.keyboard.press('ArrowRight');
    const stepped = await page.evaluate(() => window.poise.clock.time);
    assert.ok(Math.abs(stepped - 1.02) < 1e-9);
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.poise.clock.playing), true);
  }));

test('scrubbing moves cursors and robot together',
  () => withPage('stands', {}, async (page) => {
    const cursorsBefore = await cursors(page);
    const robotsBefore = await whereRobots(page);
    const box = await page.locator('.scrub').boundingBox();
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + 2, y);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.5 * box.width, y, {steps: 4});
    await page.mouse.up();
    const {time, start, end} = await page.evaluate(() => window.poise.clock);
    assert.ok(Math.abs((time - start) / (end - start) - 0.5) < 0.01);
    (await cursors(page)).forEach(
        (x, i) => assert.ok(x > cursorsBefore[i] + 50, `cursor ${i}`));
    assert.notDeepEqual(await whereRobots(page), robotsBefore);
  }));

test('dragging in a plot moves clock, cursors and robot',
  () => withPage('stands', {}, async (page) => {
    const before = await whereRobots(page);
    const box = await page.locator('.u-over').first().boundingBox();
    await page.mouse.move(box.x + 0.2 * box.width, box.y + 20);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 20, {steps: 3});
    await page.mouse.up();
    const {time, end} = await page.evaluate(() => window.poise.clock);
    assert.ok(Math.abs(time - 0.6 * end) < 0.02 * end, `clock at ${time}`);
    const [first] = await cursors(page);
    assert.ok(Math.abs(first - (box.x + 0.6 * box.width)) < 2);
    assert.notDeepEqual(await whereRobots(page), before);
  }));

test('the camera turns with the mouse',
  () => withPage('stands', {}, async (page) => {
    const eye = () => page.evaluate(
        () => window.poise.stages[0].stage.camera.position.toArray());
    const before = await eye();
    const box = await page.locator('.stage').boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 120, y, {steps: 4});
    await page.mouse.up();
    assert.notDeepEqual(await eye(), before);
  }));

test('a joint can be chosen to see its torque',
  () => withPage('stands', {}, async (page) => {
    const select = page.getByLabel('Joint');
    const other = await select.locator('option').nth(2).textContent();
    await select.selectOption({label: other});
    const plot = page.locator('.plot', {has: page.getByLabel('Joint')});
    assert.equal(await plot.locator('.legend span').textContent(), other);
  }));

test('plots zoom to the push and back',
  () => withPage('stands', {}, async (page) => {
    await page.getByRole('button', {name: 'The push'}).click();
    const [from, to] = await page.evaluate(() => window.poise.range);
    assert.ok(to - from < 2.5 && from > 0);
    await drawn(page);
    await page.screenshot({path: out('push.png')});
    await page.getByRole('button', {name: 'Whole run'}).click();
    assert.equal((await page.evaluate(() => window.poise.range))[0], 0);
  }));

test('the theme button switches from light to dark',
  () => withPage('stands', {colorScheme: 'light'}, async (page) => {
    const ground = () => page.evaluate(
        () => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.getByLabel('Light or dark').click();
    assert.notEqual(await ground(), light);
    await seek(page, 1.1);
    await drawn(page);
    await page.screenshot({path: out('dark.png')});
  }));

test('the report of a fall shows the fall',
  () => withPage('falls', {}, async (page) => {
    assert.match(await page.locator('.verdict').textContent(), /^Fell at \d/);
    const base = () => page.evaluate(() => {
      const {matrixWorld} = window.poise.stages[0].stage.robot.bodies[0];
      // Is 1 if upright: the z component of the base's z axis.
      return {height: matrixWorld.elements[14], up: matrixWorld.elements[10]};
    });
    const standing = await base();
    await page.keyboard.press('End');
    const lying = await base();
    assert.ok(lying.height < 0.7 * standing.height || lying.up < 0.6,
              JSON.stringify({standing, lying}));
    assert.equal(await page.locator('.stage .event').textContent(), 'Fallen');
    await drawn(page);
    await page.screenshot({path: out('falls.png')});
  }));

test('two runs are shown side by side at the same time',
  () => withPage('compare', {}, async (page) => {
    assert.equal(await page.locator('.stage').count(), 2);
    await seek(page, 1.6);
    const [a, b] = await whereRobots(page);
    assert.notDeepEqual(a, b);
    const labels = await page.locator('.stage .who b').allTextContents();
    assert.match(labels[0], /without zmp/);
    assert.notEqual(labels[0], labels[1]);
    // The legend names runs by A and B as the headers do: no name is truncated.
    assert.deepEqual(
        await page.locator('.plot .legend').first().locator('span')
            .allTextContents(), ['A', 'B']);
    assert.ok(await colorsOf(page, 0) > 60);
    assert.ok(await colorsOf(page, 1) > 60);
    await page.getByRole('button', {name: 'Side', exact: true}).click();
    const [left, right] = await page.evaluate(() => window.poise.stages.map(
        ({stage}) => stage.camera.position.toArray().map((x) => x.toFixed(3))));
    assert.deepEqual(left, right);
    await page.getByRole('button', {name: '3D'}).click();
    await drawn(page);
    await page.screenshot({path: out('compare.png')});
    await page.screenshot({path: out('compare_all.png'), fullPage: true});
  }));

for (const name of ['stands', 'compare', 'map']) {
  test(`a phone shows ${name} without scrolling sideways`,
    () => withPage(name, {viewport: {width: 390, height: 844}, hasTouch: true,
      isMobile: true, deviceScaleFactor: 2}, async (page) => {
      const [wide, view] = await page.evaluate(
          () => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(wide <= view, `${wide} > ${view}`);
      await page.screenshot({path: out(`phone_${name}.png`)});
    }));
}

for (const [name, note] of [
  ['empty', /header and no rows/], ['cut', /cut short/], ['one_tick', null],
]) {
  test(`a log that is ${name.replace('_', ' ')} is shown as far as it goes`,
    () => withPage(name, {}, async (page) => {
      if (note) assert.match(await page.locator('.notes').textContent(), note);
      await page.keyboard.press(' ');
      await drawn(page);
      await page.keyboard.press('End');
      await page.screenshot({path: out(`${name}.png`)});
    }));
}

test('a report of ten minutes is a file of less than 12 MB',
  () => withPage('long', {}, async (page) => {
    const {size} = statSync(pages.long);
    assert.ok(size < 12e6, String(size));
    const end = await page.evaluate(() => window.poise.clock.end);
    assert.ok(end > 599 && end <= 600, `ends at ${end}`);
    await seek(page, 300);
    const before = await whereRobots(page);
    await page.evaluate(() => window.poise.setRange([300, 306]));
    await page.keyboard.press(' ');
    await page.waitForFunction(() => window.poise.clock.time > 300.2);
    await page.keyboard.press(' ');
    assert.notDeepEqual(await whereRobots(page), before);
    await page.screenshot({path: out('long.png')});
  }));

test('another robot is shown', () => withPage('hopper', {}, async (page) => {
  assert.ok(await colorsOf(page) > 30);
  const before = await whereRobots(page);
  await seek(page, 2);
  assert.notDeepEqual(await whereRobots(page), before);
  assert.match(await page.locator('.notes').textContent(), /summary\.json/);
  // The hopper moves away, and the map of the ground follows it.
  await page.keyboard.press('End');
  const {foot, center, span} = await page.evaluate(() => {
    const [{stage, map}] = window.poise.stages;
    const [{sole}] = stage.contacts.feet;
    return {foot: sole[0], center: map.center, span: map.span};
  });
  assert.ok(foot[0] > 0.3, String(foot));
  for (const axis of [0, 1]) {
    const away = Math.abs(foot[axis] - center[axis]);
    assert.ok(away < span / 2, `${away} of ${span / 2}`);
  }
  await drawn(page);
  await page.screenshot({path: out('hopper.png')});
}));

test('the meshes of a robot are shown', () => withPage('meshes', {},
  async (page) => {
    // The corners of each shape in its own axes, m, and the color.
    const shapes = await page.evaluate(() =>
      window.poise.stages[0].stage.robot.bodies.map((body) =>
        body.children.filter(({isMesh}) => isMesh)
            .map(({geometry, material}) => {
              geometry.computeBoundingBox();
              const {min, max} = geometry.boundingBox;
              return {corners: geometry.attributes.position.count,
                size: max.toArray().map((top, i) => top - min.toArray()[i]),
                color: material.color.getHexString()};
            })));
    const sizes = [[0.2, 0.2, 0.2], [0.05, 0.05, 0.3]];
    for (const body of [0, 1]) {
      assert.equal(shapes[body].length, 1);  // No stand-in remains.
      assert.equal(shapes[body][0].corners, 4 * 3);
      sizes[body].forEach((size, i) =>
        assert.ok(Math.abs(shapes[body][0].size[i] - size) < 1e-6));
    }
    assert.notEqual(shapes[0][0].color, shapes[1][0].color);
    assert.ok(await colorsOf(page) > 30);
    const before = await whereRobots(page);
    await seek(page, 2);
    assert.notDeepEqual(await whereRobots(page), before);
    await drawn(page);
    await page.screenshot({path: out('meshes.png')});
  }));

test('two robots that differ are compared',
  () => withPage('hopper_and_humanoid', {}, async (page) => {
    await seek(page, 1.2);
    assert.ok(await colorsOf(page, 0) > 30);
    assert.ok(await colorsOf(page, 1) > 60);
  }));

test('a point of the push map replays its runs',
  () => withPage('map', {}, async (page) => {
    assert.equal(await page.locator('.point').count(), 32);
    await page.locator('.point').nth(0).click();
    assert.match(await page.locator('.replay').textContent(), /no replay/);
    await page.locator('.point').nth(2).click();
    const stages = page.frameLocator('.replay iframe').locator('.stage');
    await stages.nth(1).waitFor();
    assert.equal(await stages.count(), 2);
    await page.frames()[1].waitForFunction(() => window.poise);
    await drawn(page);
    await page.screenshot({path: out('map.png')});
  }));

test('no point of the push map hides the scale',
  () => withPage('map', {}, async (page) => {
    const hidden = await page.evaluate(() => {
      const boxes = (selector) => [...document.querySelectorAll(selector)]
          .map((each) => [each.textContent, each.getBoundingClientRect()]);
      return boxes('.scale').filter(([, a]) => boxes('.point').some(([, b]) =>
        a.left < b.right && b.left < a.right &&
        a.top < b.bottom && b.top < a.bottom)).map(([text]) => text);
    });
    assert.deepEqual(hidden, []);
  }));

test('an interrupted run has no verdict',
  () => withPage('interrupted', {}, async (page) => {
    assert.equal(await page.locator('.verdict').textContent(), 'Interrupted');
  }));
