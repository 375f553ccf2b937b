// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.

const NAMES = ['ink', 'faint', 'line', 'surface', 'limit', 'c1', 'c2', 'c3',
               'c4', 'com', 'cop', 'capture', 'support', 'force', 'push'];
const KEY = 'poise-theme';

/** The button that switches between the light and the dark theme. */
export const THEME_BUTTON = `<button class="icon theme"
  aria-label="Light or dark" title="Light or dark"><svg viewBox="0 0 16 16">
  <path d="M6.2 1.2a7 7 0 1 0 8.6 8.6A6 6 0 0 1 6.2 1.2z"/></svg></button>`;

/** Returns the present colors of style.css, for drawing on a canvas. */
export function readPalette() {
  const style = getComputedStyle(document.documentElement);
  const palette = {dark: document.documentElement.dataset.theme === 'dark'};
  for (const name of NAMES) {
    palette[name] = style.getPropertyValue(`--${name}`).trim();
  }
  return palette;
}

// Returns the chosen theme: by the page around this one, or else from storage.
// A page from disk may have no storage; access to it then throws.
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
 * Sets the theme that was chosen last, or else the system's theme. Calls back at
 * each change.
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
      // Without storage the choice is lost when the page is closed.
    }
    this.#set(theme);
  }
}
