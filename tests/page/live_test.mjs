// A drive that is still going on: the page grows, its buttons reach the simulation, and nobody else's do.
import {test} from 'node:test';
import assert from 'node:assert/strict';
import http from 'node:http';
import {spawn} from 'node:child_process';
import {browse, truth, until, eventually, shot} from './browser.mjs';

const {open} = browse();

/// Starts a simulation; `lines` is what it says.
async function simulation(t, ...options) {
  const child = spawn(process.env.KB_LIVE, options), lines = [];
  t.after(() => child.kill());      // also if the test fails
  child.stdout.on('data', (data) => lines.push(...String(data).trim().split('\n')));
  await eventually(() => lines.length);
  return {lines, port: Number(lines[0].split(' ')[1]), child, release: () => child.stdin.write('\n'), end: () => new Promise((done) => { child.on('exit', done), child.stdin.end(); })};
}
function ask(port, path, {method = 'GET', headers = {}, body} = {}) {
  return new Promise((done, fail) => {
    const request = http.request({host: '127.0.0.1', port, path, method, headers}, (answer) => {
      let text = '';
      answer.on('data', (data) => { text += data; }), answer.on('end', () => done({status: answer.statusCode, text, headers: answer.headers}));
    });
    request.on('error', fail), request.end(body);
  });
}
const json = {'Content-Type': 'application/json'};
const send = (port, body, headers = json) => ask(port, '/live/command', {method: 'POST', headers, body: JSON.stringify(body)});

test('a live page grows to the end of the drive and shows what the recording says', async (t) => {
  const run = await simulation(t, '20', '0', '60');
  const {page, faults, close} = await open(`http://127.0.0.1:${run.port}/`);
  await until(page, () => waymark.drive.count === 60);
  assert.equal(await page.textContent('#live'), '● live');
  const early = await page.evaluate(() => waymark.drive.count);
  assert.ok(early < truth.length, 'the drive still goes on');
  run.release();
  await until(page, (count) => waymark.drive.count === count && !waymark.live, truth.length);
  assert.equal(await page.textContent('#live'), 'over');
  assert.equal(await page.textContent('#outcome'), '✓ arrived', 'also if that comes after the last tick');
  assert.equal(await page.textContent('#spoken'), 'the drive is over: arrived');
  assert.equal(await page.getAttribute('[data-road="LM7.E"]', 'aria-valuetext'), 'closed', 'the slider of a road that the scenario closed has moved');
  assert.equal(await page.getAttribute('[data-road="LM6.E"]', 'aria-valuetext'), 'open');
  const all = await page.evaluate(() => Array.from({length: waymark.drive.count}, (_, i) => ({
    strategy: waymark.drive.strategyName(i), leg: waymark.drive.leg.at(i), status: waymark.drive.status.at(i), t: waymark.drive.t[i],
    fired: waymark.drive.fired[i].map((r) => waymark.drive.rules[r].name), values: Object.fromEntries(waymark.drive.cells.map((cell) => [cell.name, cell.steps.at(i)]))})));
  all.forEach((one, i) => {
    for (const key of ['strategy', 'leg', 'status']) assert.equal(one[key], truth[i][key], `${key} at tick ${i + 1}`);
    assert.deepEqual(one.fired, truth[i].fired);
    for (const [name, value] of Object.entries(truth[i].values)) assert.ok(Math.abs(one.values[name] - value) < 1e-4, `${name} at tick ${i + 1}`);
  });
  assert.equal(await page.evaluate(() => waymark.drive.log.length), all.reduce((sum, one, i) => sum + one.fired.filter((name) => !i || !all[i - 1].fired.includes(name)).length, 0), 'firings go on over the seams');
  assert.deepEqual(faults.filter((fault) => !fault.startsWith(`network: http://127.0.0.1:${run.port}/`)), []);
  await close(), await run.end();
});

test('sliders close and open roads, by mouse and by keys; buttons press commands and pause', async (t) => {
  const run = await simulation(t, '150', '0', '20');
  const {page, close} = await open(`http://localhost:${run.port}/`);
  await until(page, () => waymark.drive.count === 20);
  await page.click('#tab-live');
  const slider = page.getByRole('slider', {name: 'Road LM7.E, LM7 – LM13'}), says = (text) => page.waitForSelector(`[data-road="LM7.E"][aria-valuetext="${text}"]`);
  await says('open');
  await slider.focus();
  await page.keyboard.press('ArrowRight');
  await says('closed');
  await shot(page, 'live');
  await page.keyboard.press('Home');
  await says('open');
  const box = await slider.boundingBox();
  await page.mouse.click(box.x + box.width - 3, box.y + box.height / 2);
  await says('closed');
  await page.mouse.click(box.x + 3, box.y + box.height / 2);
  await says('open');
  await page.click('#live-panel button:has-text("Start1")');
  run.release();
  await until(page, () => waymark.drive.count > 20);
  await page.click('#live-panel button:has-text("Pause the simulation")');
  await page.waitForSelector('#live-panel button[aria-pressed="true"]');
  await eventually(() => run.lines.includes('pause'));   // no tick after this line
  const halted = JSON.parse((await ask(run.port, '/live/frames?from=0')).text).frames.count;
  await until(page, (count) => waymark.drive.count === count, halted);
  await page.waitForTimeout(1000);
  assert.equal(await page.evaluate(() => waymark.drive.count), halted, 'it stands still');
  await page.click('#live-panel button:has-text("Pause the simulation")');
  await until(page, (count) => waymark.drive.count > count, halted);
  assert.deepEqual(run.lines.slice(1), ['close LM7.E', 'open LM7.E', 'close LM7.E', 'open LM7.E', 'press Start1', 'pause', 'resume']);
  await run.end();
  await until(page, () => document.getElementById('live').textContent.includes('does not answer'));
  assert.equal(await page.textContent('#spoken'), 'the simulation does not answer');
  await close();
});

test('what would act on a drive that is over acts no more, and says so', async (t) => {
  const run = await simulation(t, '5', '0', '20');
  const {page, close} = await open(`http://127.0.0.1:${run.port}/`);
  await page.click('#tab-live');
  await page.focus('[data-road="LM7.E"]');
  run.release();
  await until(page, () => !waymark.live);
  assert.equal(await page.locator('#live-panel :is(button, input):enabled').count(), 0);
  assert.ok((await page.textContent('#live-panel')).startsWith('The drive is over'));
  assert.equal(await page.evaluate(() => document.activeElement.id), 'live-panel', 'the keyboard keeps its place');
  // A page that is opened now says the same.
  const late = await open(`http://127.0.0.1:${run.port}/`);
  await until(late.page, () => !waymark.live);
  assert.equal(await late.page.textContent('#outcome'), '✓ arrived');
  await late.close(), await close(), await run.end();
});

test('who looks back is left there while the drive goes on', async (t) => {
  const run = await simulation(t, '150');
  const {page, close} = await open(`http://127.0.0.1:${run.port}/`);
  await until(page, () => waymark.drive.count > 3);
  await page.keyboard.press('Home');
  await page.waitForTimeout(700);
  assert.equal(await page.evaluate(() => waymark.frame), 0);
  await page.keyboard.press('End');
  const at = await page.evaluate(() => waymark.frame);
  await until(page, (frame) => waymark.frame > frame + 5, at);
  await close(), await run.end();
});

test('the server refuses what does not come from its own page', async (t) => {
  const run = await simulation(t), {port} = run;
  assert.equal((await ask(port, '/', {headers: {Host: `evil.example:${port}`}})).status, 403);
  assert.equal((await ask(port, '/live/frames?from=0', {headers: {Host: 'evil.example'}})).status, 403);
  assert.equal((await send(port, {what: 'pause'}, {'Content-Type': 'text/plain'})).status, 415);
  assert.equal((await send(port, {what: 'pause'}, {'Content-Type': 'application/x-www-form-urlencoded'})).status, 415);
  for (const wrong of [{what: 'close', name: 'LM99.E'}, {what: 'press', name: 'LM5'}, {what: 'fly'}, {name: 'LM7.E'}, [], 'close', {what: 'close', name: 7}, {what: 1}]) {
    assert.equal((await send(port, wrong)).status, 400, JSON.stringify(wrong));
  }
  assert.equal((await ask(port, '/live/command', {method: 'POST', headers: json, body: '{"what":'})).status, 400);
  assert.equal((await ask(port, '/live/command', {method: 'POST', headers: json, body: `"${'x'.repeat(5000)}"`})).status, 413);
  for (const from of ['', '-1', 'x', '1e3', '99999999999999999999']) assert.equal((await ask(port, `/live/frames?from=${from}`)).status, 400, from);
  assert.equal((await ask(port, '/etc/passwd')).status, 404);
  assert.equal((await ask(port, '/')).headers['x-frame-options'], 'DENY');
  const late = JSON.parse((await ask(port, '/live/frames?from=100000')).text);
  assert.equal(late.frames.count, 0);
  assert.deepEqual(run.lines.slice(1), [], 'nothing of it has reached the simulation');
  const other = await simulation(t, '20', String(port));
  assert.equal(other.lines[0], 'no port', 'a port is not shared');
  await run.end();
});

test('is to be reached from this machine alone', async (t) => {
  const {networkInterfaces} = await import('node:os');
  const run = await simulation(t);
  for (const {address, internal, family} of Object.values(networkInterfaces()).flat()) {
    if (internal || family !== 'IPv4') continue;
    await assert.rejects(new Promise((done, fail) => http.get({host: address, port: run.port, path: '/', timeout: 2000}, done).on('error', fail).on('timeout', () => fail(new Error('no answer')))));
  }
  await run.end();
});
