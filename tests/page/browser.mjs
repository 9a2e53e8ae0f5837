// One browser for all tests of a file, and pages that notice whatever goes wrong in them.
import {readFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import path from 'node:path';
import assert from 'node:assert/strict';
import {before, after} from 'node:test';
import {chromium} from 'playwright-core';

export const folder = path.dirname(fileURLToPath(import.meta.url));
export const truth = JSON.parse(readFileSync(path.join(folder, 'drive.json'), 'utf8'));

async function launch() {
  // A container has no user namespaces to build a sandbox from; the pages are our own.
  return chromium.launch({executablePath: process.env.KB_CHROMIUM, args: ['--no-sandbox', '--disable-dev-shm-usage', '--disable-background-networking']});
}

/// Opens a page from its file. `faults` collects what the console, scripts and the network complain of or ask for.
async function open(browser, file, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 720}, ...options});
  const page = await context.newPage(), faults = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !message.text().includes('willReadFrequently')) faults.push(`console: ${message.text()}`); });
  page.on('pageerror', (error) => faults.push(`script: ${error.message}`));
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) faults.push(`network: ${request.url()}`); });
  await page.goto(file.includes('://') ? file : `file://${path.join(folder, file)}`);
  return {page, faults, close: () => context.close()};
}

/// A browser for the tests of a file. `withPage` opens a page, acts on it, and fails if the page complained of anything.
export function browse() {
  let browser;
  before(async () => { browser = await launch(); });
  after(() => browser.close());
  const openPage = (file, options) => open(browser, file, options);
  async function withPage(file, act, options) {
    const {page, faults, close} = await openPage(file, options);
    await act(page);
    assert.deepEqual(faults, []);
    await close();
  }
  return {open: openPage, withPage};
}

export const tick = (page) => page.evaluate(() => waymark.frame);
export const shown = async (page) => (await page.textContent('#strategy')).replace('no strategy', '');
/// The page shows what the recording says of its tick.
export async function agrees(page) {
  const at = await tick(page);
  assert.equal(await shown(page), truth[at].strategy, `strategy at tick ${at + 1}`);
  assert.equal((await page.textContent('#status')).replace('▲ ', ''), truth[at].status, `status at tick ${at + 1}`);
  return at;
}
export async function shot(page, name) { await page.screenshot({path: path.join(folder, 'shots', `${name}.png`)}); }
/// Waits until something holds: in a page (its policy forbids what Playwright's own waiting does), or here.
export const until = (page, holds, argument) => eventually(() => page.evaluate(holds, argument), holds);
export async function eventually(holds, told = holds) {
  for (const end = Date.now() + 20000; Date.now() < end; await new Promise((done) => setTimeout(done, 30))) {
    if (await holds()) return;
  }
  assert.fail(`never: ${told}`);
}
