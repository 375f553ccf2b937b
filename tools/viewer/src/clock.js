// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

/** The one time of a page: everything drawn follows it. */
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

  /** Calls back after every change of time, speed, or playing. */
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

  /** Called once a frame with its time, ms. */
  frame(now) {
    if (!this.playing) return;
    // A page in the background gets no frames: do not jump when it is back.
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
