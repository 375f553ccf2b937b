// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

/** Formats a number for a live display: three digits, a true minus sign. */
export function formatNumber(value) {
  if (value === undefined || value === null || Number.isNaN(value)) return '–';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : '−∞';
  const size = Math.abs(value);
  let text;
  if (size === 0) text = '0';
  else if (size >= 1e5) text = value.toExponential(1);
  else if (size >= 100) text = value.toFixed(0);
  else if (size >= 10) text = value.toFixed(1);
  else if (size >= 0.01) text = value.toFixed(2);
  else if (size >= 5e-4) text = value.toFixed(4);
  else text = value.toExponential(1);
  return text.replaceAll('-', '−').replace('e+', 'e');
}

/** Returns "strong_push" as a title: "Strong push". */
export function titleOf(name) {
  const words = String(name).replaceAll('_', ' ').trim();
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Escapes text for use in HTML. */
export function escapeHtml(text) {
  return String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}
