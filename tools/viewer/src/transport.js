// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

const PLAY = '<svg viewBox="0 0 16 16"><path d="M3 1.5v13l11-6.5z"/></svg>';
const PAUSE =
    '<svg viewBox="0 0 16 16"><path d="M3 1.5h3.6v13H3zm6.4 0H13v13H9.4z"/></svg>';

/** The controls of a Clock: play, pause, time bar and speed. */
export class Transport {
  constructor(parent, clock, {pushes, falls}) {
    this.clock = clock;
    this.element = document.createElement('div');
    this.element.className = 'transport';
    this.element.innerHTML = `
      <button class="play" aria-label="Play"></button>
      <output aria-label="Time"></output>
      <div class="scrub" role="slider" tabindex="0" aria-label="Time">
        <div class="rail"></div><div class="done"></div><div class="knob"></div>
      </div>
      <select aria-label="Speed">
        ${[0.05, 0.1, 0.25, 0.5, 1, 2, 4].map((speed) =>
        `<option value="${speed}"${speed === 1 ? ' selected' : ''}>×&#8239;${speed}</option>`).join('')}
      </select>`;
    parent.append(this.element);
    const part = (selector) => this.element.querySelector(selector);
    this.button = part('.play');
    this.output = part('output');
    this.scrub = part('.scrub');
    this.done = part('.done');
    this.knob = part('.knob');
    this.button.addEventListener('click', () => clock.toggle());
    part('select').addEventListener(
        'change', (event) => clock.setSpeed(Number(event.target.value)));
    for (const [from, to] of pushes) {
      const mark = this.#mark('push-mark', from, 'Push');
      mark.style.width = `${100 * (to - from) / this.#span}%`;
    }
    for (const fall of falls) this.#mark('fall-mark', fall, 'Fell');
    this.#listen();
    clock.listen(() => this.update());
    this.update();
  }

  get #span() {
    return this.clock.end - this.clock.start || 1;
  }

  #percent(time) {
    return `${100 * (time - this.clock.start) / this.#span}%`;
  }

  #mark(name, time, title) {
    const mark = document.createElement('div');
    mark.className = name;
    mark.title = title;
    mark.style.left = this.#percent(time);
    this.knob.before(mark);
    return mark;
  }

  #listen() {
    const {clock, scrub} = this;
    const seek = (event) => {
      const box = scrub.getBoundingClientRect();
      clock.seek(clock.start +
                 (event.clientX - box.left) / box.width * this.#span);
    };
    scrub.addEventListener('pointerdown', (event) => {
      scrub.setPointerCapture(event.pointerId);
      seek(event);
    });
    scrub.addEventListener('pointermove', (event) => {
      if (scrub.hasPointerCapture(event.pointerId)) seek(event);
    });
    window.addEventListener('keydown', (event) => {
      if (event.target.matches('select, input') || event.ctrlKey ||
          event.metaKey || event.altKey) {
        return;
      }
      const step = event.shiftKey ? 0.001 : 0.02;
      if (event.key === ' ') clock.toggle();
      else if (event.key === 'ArrowRight') clock.seek(clock.time + step);
      else if (event.key === 'ArrowLeft') clock.seek(clock.time - step);
      else if (event.key === 'Home') clock.seek(clock.start);
      else if (event.key === 'End') clock.seek(clock.end);
      else return;
      event.preventDefault();
    });
  }

  update() {
    const {clock} = this;
    const icon = clock.playing ? PAUSE : PLAY;
    if (this.icon !== icon) {
      this.icon = icon;
      this.button.innerHTML = icon;
      this.button.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
    }
    this.output.innerHTML =
        `${clock.time.toFixed(clock.end < 100 ? 3 : 2)}<small> s</small>`;
    this.scrub.setAttribute('aria-valuenow', clock.time.toFixed(3));
    this.scrub.setAttribute('aria-valuemin', clock.start.toFixed(3));
    this.scrub.setAttribute('aria-valuemax', clock.end.toFixed(3));
    this.done.style.width = this.knob.style.left = this.#percent(clock.time);
  }
}
