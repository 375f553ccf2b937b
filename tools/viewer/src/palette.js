// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

const NAMES = ['ink', 'faint', 'line', 'surface', 'limit', 'c1', 'c2', 'c3',
               'c4', 'com', 'cop', 'capture', 'support', 'force', 'push'];
const KEY = 'poise-theme';

/** What turns light into dark, and back. */
export const THEME_BUTTON = `<button class="icon theme"
  aria-label="Light or dark" title="Light or dark"><svg viewBox="0 0 16 16">
  <path d="M6.2 1.2a7 7 0 1 0 8.6 8.6A6 6 0 0 1 6.2 1.2z"/></svg></button>`;

/** The colors of style.css as they are now, for what CSS does not draw. */
export function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const palette = {dark: document.documentElement.dataset.theme === 'dark'};
  for (const name of NAMES) {
    palette[name] = style.getPropertyValue(`--${name}`).trim();
  }
  return palette;
}

// What was chosen: by the page around this one, or before. A page from disk may
// have no storage, and throws when asked for it.
function remembered() {
  const told = /theme=(light|dark)/.exec(location.hash);
  if (told) return told[1];
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/**
 * Sets the theme that was chosen last, or else follows the system's; calls back
 * when it changes.
 */
export class Theme {
  #changed;

  constructor(changed) {
    const system = matchMedia('(prefers-color-scheme: dark)');
    const follow = () => {
      this.#set(remembered() ??
                (system.matches ? 'dark' : 'light'));
    };
    follow();
    this.#changed = changed;
    system.addEventListener('change', follow);
  }

  #set(theme) {
    document.documentElement.dataset.theme = theme;
    this.#changed?.(readPalette());
  }

  toggle() {
    const theme = readPalette().dark ? 'light' : 'dark';
    try {
      localStorage.setItem(KEY, theme);
    } catch {
      // It then lasts as long as the page.
    }
    this.#set(theme);
  }
}
