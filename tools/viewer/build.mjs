// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Builds the pages dist/NAME.html, each of which contains its script, its style
// and a placeholder for data. Also writes dist/sources.sha256, the check sums of
// all sources and pages.
//     npm ci --ignore-scripts && node build.mjs [--out DIR]
import {createHash} from 'node:crypto';
import {mkdirSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import esbuild from 'esbuild';

const here = path.dirname(fileURLToPath(import.meta.url));
const pages = ['report', 'map'];
const placeholder = '"POISE-DATA"';

/** Returns all files from which the pages are built, in a fixed order. */
export function sourceFiles() {
  const sources = readdirSync(path.join(here, 'src')).sort();
  return ['package.json', 'package-lock.json', 'build.mjs']
      .concat(sources.map((name) => `src/${name}`));
}

function sha256(bytes) {
  return createHash('sha256').update(bytes).digest('hex');
}

function read(name) {
  return readFileSync(path.join(here, name), 'utf8');
}

async function buildPage(name) {
  const result = await esbuild.build({
    entryPoints: [path.join(here, `src/${name}.js`)],
    absWorkingDir: here,
    bundle: true,
    charset: 'utf8',
    format: 'iife',
    legalComments: 'inline',
    loader: {'.css': 'text'},
    logLevel: 'warning',
    minify: true,
    target: ['chrome100', 'firefox100', 'safari15'],
    write: false,
  });
  // Inside a page, no part of the script may look like its end.
  const script = result.outputFiles[0].text.replaceAll('</script', '<\\/script');
  // A replacement by a function, because $ signs in a string are patterns.
  const page = read(`src/${name}.html`).replace('/* SCRIPT */', () => script);
  if (page.split(placeholder).length !== 2) {
    throw new Error(`${name}.html must have ${placeholder} exactly once`);
  }
  return page;
}

export async function build(out) {
  mkdirSync(out, {recursive: true});
  const lines = sourceFiles().map((name) => `${sha256(read(name))}  ${name}`);
  for (const name of pages) {
    const page = await buildPage(name);
    writeFileSync(path.join(out, `${name}.html`), page);
    lines.push(`${sha256(page)}  dist/${name}.html`);
  }
  writeFileSync(path.join(out, 'sources.sha256'), lines.join('\n') + '\n');
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const flag = process.argv.indexOf('--out');
  await build(flag < 0 ? path.join(here, 'dist') : process.argv[flag + 1]);
}
