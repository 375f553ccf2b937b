// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

/** The time of a page, which all its views show. */
export class Clock {
  #listeners = [];
  #last = null;

  constructor(start, end) {
    this.start = start;
    this.end = end;
    this.time = start;
    this.speed = 1;
    this.playing = false;
  }

  /** Registers a callback for each change of time, speed or playing. */
  listen(listener) {
    this.#listeners.push(listener);
  }

  #tell() {
    for (const listener of this.#listeners) listener(this);
  }

  seek(time) {
    this.time = Math.min(this.end, Math.max(this.start, time));
    this.#tell();
  }

  setSpeed(speed) {
    this.speed = speed;
    this.#tell();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (!(this.end > this.start) || this.playing) return;
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.#last = null;
    this.#tell();
  }

  pause() {
    this.playing = false;
    this.#tell();
  }

  /** Advances the clock. Call it once per frame with the frame's time, ms. */
  frame(now) {
    if (!this.playing) return;
    // A page in the background gets no frames. Limit the step, so that the
    // clock does not jump when the page is visible again.
    const passed = this.#last === null ? 0 : Math.min(0.1, (now - this.#last) / 1e3);
    this.#last = now;
    if (this.time + passed * this.speed >= this.end) {
      this.playing = false;
      this.seek(this.end);
    } else {
      this.seek(this.time + passed * this.speed);
    }
  }
}
