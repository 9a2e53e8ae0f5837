// What the page explains: facts, satellites, rules, reasons; and pages of odd recordings.
import {test} from 'node:test';
import assert from 'node:assert/strict';
import {browse, tick, truth, shot, agrees, until} from './browser.mjs';

const {withPage} = browse();
const go = (page, at) => page.evaluate((to) => waymark.go(to), at);
const firing = (name) => truth.findIndex((frame) => frame.fired.includes(name));
const press = (page, where, name) => page.locator(`${where} button[title="${name}"]`).click();

test('a click on a satellite says which rule set it, where that is written, and on what conditions', () => withPage('drive.html', async (page) => {
  const at = firing('arrive[Route1[LM1,LM5]]');
  await go(page, at + 3);
  await press(page, '#satellites', 'sat LM2');
  const why = await page.textContent('#why-panel');
  for (const words of ['sat LM2', 'satellite', `since tick ${at + 1}`, 'arrive[Route1[LM1,LM5]]', 'at route', '+sat LM2', 'seen LM5', 'sat LM5', 'mission.kb:']) assert.ok(why.includes(words), `${words} in: ${why}`);
  assert.equal(await page.getAttribute('#why-panel .large', 'data-value'), '1');
  assert.equal(await page.locator('#why-panel .rule-box .fails').count(), 0, 'all its conditions held when it fired');
  await page.click('#why-panel .jumps button:first-child');
  assert.equal(await tick(page), at);
  await shot(page, 'why');
}));

test('a click on a fact says its certainty, whether it is seen, and its threshold', () => withPage('drive.html', async (page) => {
  await go(page, firing('arrive[Route1[LM1,LM5]]'));
  await press(page, '#facts', 'LM5');
  const why = await page.textContent('#why-panel');
  assert.match(why, /fact/), assert.match(why, /● Seen since tick \d+/), assert.match(why, /above 0\.5/);
  await go(page, 0);
  assert.match(await page.textContent('#why-panel'), /Not seen: −1 is not above 0\.75/);
}));

test('what does not hold is said of a strategy that does not run', () => withPage('drive.html', async (page) => {
  const at = firing('go_round') + 2;
  await go(page, at);
  assert.equal(truth[at].strategy, 'Avoid');
  await press(page, '#history-names', 'Move.mark');
  const why = await page.textContent('#why-panel');
  assert.match(why, /It does not run; Avoid does/);
  assert.equal(await page.locator('#why-panel li.not > .said').last().textContent(), 'not sat Avoid');
  await page.click('#strategy');
  assert.match(await page.textContent('#why-panel'), /Avoid.*It runs/s);
}));

test('a recording without a floor shows the mind alone', () => withPage('floorless.html', async (page) => {
  assert.equal(await page.locator('.floor').isVisible(), false);
  assert.equal(await page.locator('.of-legs').isVisible(), false);
  const at = firing('go_round') + 2;
  await go(page, at);
  assert.equal(await page.textContent('#strategy'), truth[at].strategy);
  await page.click('#strategy');
  assert.match(await page.textContent('#why-panel'), /Avoid.*It runs/s);
  assert.ok((await page.locator('#history').boundingBox()).height > 100);
  await shot(page, 'floorless');
}));

test('the conditions of every rule hold at every tick at which it fired', () => withPage('drive.html', async (page) => {
  const wrong = await page.evaluate(() => {
    const d = waymark.drive, out = [];
    d.fired.forEach((rules, frame) => rules.forEach((r) => { if (!waymark.conditions.holds(d.rules[r].condition, frame, d.rules[r].level)) out.push(`${d.rules[r].name} at ${frame}`); }));
    // ... and a rule that fires while it holds fires at no other tick.
    for (const rule of d.rules.filter((one) => one.eachTick)) {
      for (let frame = 0; frame < d.count; ++frame) if (waymark.conditions.holds(rule.condition, frame, rule.level) !== d.firedAt(rule, frame)) out.push(`${rule.name} at ${frame}, or not`);
    }
    return out;
  });
  assert.deepEqual(wrong, []);
}));

test('the log has each rule when it fired; a click goes there and explains', () => withPage('drive.html', async (page) => {
  const at = firing('go_round');
  await go(page, at);
  await page.locator('#log button.row.current', {hasText: 'go_round'}).click();
  assert.equal(await tick(page), at);
  const why = await page.textContent('#why-panel');
  for (const words of ['go_round', 'fired at this tick', 'seen Obst', 'not sat Avoid', '+sat Avoid', 'Written in']) assert.ok(why.includes(words), words);
  assert.equal(await page.locator('#why-panel .fails').count(), 0);
  await page.keyboard.press('ArrowLeft');
  assert.ok((await page.textContent('#why-panel')).includes('has not fired yet'));
  assert.ok(await page.locator('#why-panel .fails').count() > 0, 'something did not hold one tick before');
  await page.keyboard.press('Escape');
  assert.equal(await page.getAttribute('#tab-log', 'aria-selected'), 'true');
}));

/// Whether the row of the last firing is in sight.
const lastFiringInSight = () => {
  const box = document.getElementById('log').getBoundingClientRect(), row = document.querySelector(`#log [data-entry="${waymark.log.find(waymark.frame)}"]`);
  return row !== null && row.getBoundingClientRect().top >= box.top && row.getBoundingClientRect().top < box.bottom;
};

test('the log shows the tick at which the page is opened, and the one that was chosen while it was hidden', () => withPage('drive.html#tick=500', async (page) => {
  await until(page, lastFiringInSight);
  await page.click('#tab-why');
  await page.keyboard.press('End');
  await page.click('#tab-log');
  await until(page, lastFiringInSight);
}));

test('a click into the history goes to its tick and explains its cell', () => withPage('drive.html', async (page) => {
  await page.click('#by-tick');
  const box = await page.locator('#cells').boundingBox(), width = Number(await page.inputValue('#width'));
  await page.mouse.click(box.x + 40 * width + 1, box.y + 18 + 8);
  assert.equal(await tick(page), 40);
  assert.match(await page.textContent('#why-panel h3'), /^Move\.mark$/);
  await agrees(page);
}));

test('the wheels count in a frame of their own, and are shown in that of the floor', () => withPage('drive.html', async (page) => {
  const off = await page.evaluate(() => {
    const d = waymark.drive, told = Array.from({length: d.count}, (_, i) => d.byWheels(i));
    return told.map((at, i) => (at ? Math.hypot(at.x - d.x[i], at.y - d.y[i]) : 0));
  });
  assert.ok(Math.max(...off) > 0.02, 'they are wrong by a little');
  assert.ok(Math.max(...off) < 0.3, `and by no more than their drift: ${Math.max(...off)}`);
}));

test('the leg is told, and that it is a detour', () => withPage('drive.html', async (page) => {
  const detour = truth.findIndex((frame) => frame.leg === 'Route1[LM7,LM11]');
  await go(page, detour);
  assert.equal(await page.textContent('#leg'), 'LM7 → LM11detour');
  await go(page, detour - 1);
  assert.equal(await page.textContent('#leg'), 'LM6 → LM7');
}));

test('a note is told from its tick on, and leads back to it', () => withPage('drive.html', async (page) => {
  const at = truth.findIndex((frame) => frame.notes.length > 0);
  await go(page, at - 1);
  assert.equal(await page.textContent('#note'), 'none yet');
  await go(page, at + 9);
  assert.ok((await page.textContent('#note')).includes(truth[at].notes[0]));
  await page.click('#note');
  assert.equal(await tick(page), at);
}));

test('names cannot break out of the page', () => withPage('nasty.html', async (page) => {
  assert.ok((await page.title()).startsWith("</script><script>document.title='broken'"));
  assert.ok((await page.textContent('#title')).includes('{{data}}'));
  await go(page, 6);
  assert.ok((await page.textContent('#status')).includes('</script>'));
  await page.evaluate(() => { for (let id = 0; id < waymark.drive.cells.length; ++id) waymark.choose({cell: id}); for (let id = 0; id < waymark.drive.rules.length; ++id) waymark.choose({rule: id}); });
  assert.equal(await page.locator('script').count(), 2);
}));

test('odd recordings are shown without a fault', async () => {
  for (const file of ['empty.html', 'one.html', 'not_finite.html']) {
    await withPage(file, async (page) => {
      for (const key of ['End', 'ArrowLeft', 'Shift+ArrowLeft', 'Home', 'Space', 'f', 's', '.']) await page.keyboard.press(key);
      await page.waitForTimeout(120);
      await page.evaluate(() => { for (let frame = 0; frame < waymark.drive.count; ++frame) waymark.go(frame); });
      assert.match(await page.textContent('#clock'), /tick|no ticks/, file);
    });
  }
});

test('what can be pressed has a name, and what is told by colour is told by words too', () => withPage('drive.html', async (page) => {
  await go(page, 150);
  const nameless = await page.$$eval('button, input, select, canvas[role]', (all) => all.filter((one) => !(one.getAttribute('aria-label') || one.textContent.trim() || one.closest('label'))).map((one) => one.outerHTML));
  assert.deepEqual(nameless, []);
  assert.match(await page.locator('#facts button[title="LM11"]').getAttribute('aria-label'), /^LM11: −1, awaited$/);
  assert.equal(await page.evaluate(() => new Set(waymark.drive.kinds.map((kind) => kind.dash)).size), await page.evaluate(() => waymark.drive.kinds.length));
}));
