// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
//
// Writes a picture of a page, or of the part that a CSS selector names, as in
// docs/generated/figures:
//     node screenshot.mjs PAGE.html OUT.png [SELECTOR]
import path from 'node:path';
import {chromium} from 'playwright-core';

const [page_file, out, selector] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', '--disable-background-networking'],
  timeout: 600e3,
});
const page = await browser.newPage(
    {viewport: {width: 1440, height: 900}, deviceScaleFactor: 2,
      colorScheme: 'light'});
page.setDefaultTimeout(600e3);
await page.goto(`file://${path.resolve(page_file)}`);
await page.waitForFunction(() => window.poise);
const part = selector ? page.locator(selector) : page;
await part.screenshot({path: out});
await browser.close();
