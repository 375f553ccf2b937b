// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// The pushes of a run, from `pushes` of its summary.json. A force is always the
// applied peak. Impulse divided by duration would be only the mean force.
import {formatNumber} from './format.js';

const MOST_NAMED = 3;

/** Returns the force of a push at a time, N. sim/push.h defines the shapes. */
export function forceAt({shape, at, duration, force}, time, dt) {
  let part = 0;
  if (shape === 'impulse') {
    // The whole impulse acts within one tick.
    if (time >= at - dt / 2 && time < at + dt / 2) part = duration / dt;
  } else if (time >= at && time < at + duration) {
    const isSine = shape === 'half_sine';
    part = isSine ? Math.sin(Math.PI * (time - at) / duration) : 1;
  }
  return force.map((f) => part * f);
}

/** Returns the largest number of pushes that act at the same time. */
export function mostAtOnce(pushes) {
  const overlaps = (a, b) =>
    a.at <= b.at && b.at <= a.at + a.duration;
  return Math.max(0, ...pushes.map(
      (push) => pushes.filter((other) => overlaps(other, push)).length));
}

/** Describes a push: "half sine of 100 N for 0.15 s on torso". */
export function pushText({shape, force, duration, link, impulse_Ns: impulse}) {
  const on = link ? ` on ${link}` : '';
  if (shape === 'impulse') return `${formatNumber(impulse)} N·s at once${on}`;
  return (shape === 'half_sine' ? 'half sine of ' : '') +
      `${formatNumber(Math.hypot(...force))} N for ` +
      `${formatNumber(duration)} s${on}`;
}

/** Describes all pushes of a run; '' if there were none. */
export function pushesText({pushes, impulse_Ns: impulse, push_link: link}) {
  if (!pushes) {  // Summaries of older versions have no forces.
    return impulse > 0 ?
        `${formatNumber(impulse)} N·s${link ? ` on ${link}` : ''}` : '';
  }
  const texts = pushes.filter((push) => push.impulse_Ns > 0).map(pushText);
  const more = texts.length - MOST_NAMED;
  return texts.slice(0, MOST_NAMED).join(', then ') +
      (more > 0 ? `, and ${more} more` : '');
}
