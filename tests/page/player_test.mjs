// The player: it plays, scrubs, steps, and what it shows is what the recording says.
import {test} from 'node:test';
import assert from 'node:assert/strict';
import {browse, tick, truth, agrees, shown, shot, until} from './browser.mjs';

const {open, withPage} = browse();

test('plays at the speed that is chosen, and pauses', () => withPage('drive.html', async (page) => {
  await page.selectOption('#speed', '4');
  await page.keyboard.press('Tab');
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press('Space');
  assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
  // Measured by the clock of the frames themselves: a machine that stalls draws fewer of them, and no slower drive.
  const speed = await page.evaluate(() => new Promise((done) => {
    let begin;
    const turn = (now) => {
      begin ??= [now, waymark.player.time];
      const measured = now > begin[0];   // the first frame may come late
      if (measured && (waymark.player.time > 6 || now - begin[0] > 20000)) done((waymark.player.time - begin[1]) / (now - begin[0]) * 1000);
      else requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
  }));
  await page.keyboard.press('Space');
  assert.ok(speed > 3.99 && speed < 4.01, `four times as fast as the drive, not ${speed}`);
  const at = await agrees(page);
  await page.waitForTimeout(150);
  assert.equal(await tick(page), at, 'it stands still');
}));

test('plays to the end and begins anew', () => withPage('drive.html', async (page) => {
  await page.selectOption('#speed', '32');
  await page.click('#play');
  await until(page, (last) => waymark.frame === last && !waymark.player.playing, truth.length - 1);
  await agrees(page);
  await page.selectOption('#speed', '1');
  await page.click('#play');
  await until(page, () => waymark.player.playing && waymark.frame < 100);
}));

test('scrubs to any tick, forward and back', () => withPage('drive.html', async (page) => {
  for (const at of [0, 33, 150, 100, truth.length - 1, 34, 95, 1]) {
    await page.$eval('#scrub', (bar, value) => { bar.value = value, bar.dispatchEvent(new Event('input', {bubbles: true})); }, at);
    assert.equal(await agrees(page), at);
  }
  const box = await page.locator('#scrub').boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  assert.ok(Math.abs(await agrees(page) - truth.length / 2) < 4);
}));

test('is driven by the keyboard alone', () => withPage('drive.html', async (page) => {
  const press = async (key, at) => { await page.keyboard.press(key), assert.equal(await agrees(page), at, key); };
  await press('ArrowRight', 1), await press('ArrowRight', 2), await press('ArrowLeft', 1);
  await press('Shift+ArrowRight', 11), await press('Shift+ArrowLeft', 1), await press('ArrowLeft', 0), await press('ArrowLeft', 0);
  await press('End', truth.length - 1), await press('ArrowRight', truth.length - 1), await press('Home', 0);
  await page.keyboard.press('+'), await page.keyboard.press('+'), await page.keyboard.press('-');
  assert.equal(await page.inputValue('#speed'), '2');
  await page.keyboard.press('.');
  const turn = await tick(page);
  assert.ok(turn > 0), await page.keyboard.press(','), assert.equal(await tick(page), 0);
  await page.keyboard.press('?');
  assert.ok(await page.locator('#help').isVisible());
  await page.keyboard.press('Escape');
  assert.ok(!await page.locator('#help').isVisible());
  await page.focus('#scrub'), await press('ArrowRight', 1);
  // Where the focus is can be seen, and what has it can be pressed.
  await page.focus('#forward');
  await page.keyboard.press('Space');
  assert.equal(await tick(page), 2);
  await page.keyboard.press('Shift+Tab'), await page.keyboard.press('Tab');
  assert.notEqual(await page.$eval('#forward', (button) => getComputedStyle(button).outlineStyle), 'none');
}));

test('shows at every tick the strategy and the values that the recording has', () => withPage('drive.html', async (page) => {
  const all = await page.evaluate(() => Array.from({length: waymark.drive.count}, (_, i) => {
    waymark.go(i);
    const d = waymark.drive;
    return {strategy: document.getElementById('strategy').textContent.replace('no strategy', ''), status: d.status.at(i), leg: d.leg.at(i), t: d.t[i],
      fired: d.fired[i].map((r) => d.rules[r].name), values: Object.fromEntries(d.cells.map((cell) => [cell.name, cell.steps.at(i)]))};
  }));
  assert.equal(all.length, truth.length);
  all.forEach((one, i) => {
    for (const key of ['strategy', 'status', 'leg']) assert.equal(one[key], truth[i][key], `${key} at tick ${i + 1}`);
    assert.deepEqual(one.fired, truth[i].fired, `rules at tick ${i + 1}`);
    for (const [name, value] of Object.entries(truth[i].values)) assert.ok(Math.abs(one.values[name] - value) < 1e-4, `${name} at tick ${i + 1}`);
  });
}));

test('jumps to a tick that the address names', async () => {
  const {page, close} = await open('drive.html');
  await page.goto(`${page.url()}#tick=96`), await page.reload();
  assert.equal(await agrees(page), 95);
  await close();
});

test('loads ten minutes at once and scrubs them smoothly', () => withPage('long.html', async (page) => {
  const {load, worst, middle, count} = await page.evaluate(() => {
    const d = waymark.drive, times = [];
    for (let k = 0; k < 60; ++k) {
      const begin = performance.now();
      waymark.go(Math.floor(d.count * ((k * 0.618) % 1)));
      times.push(performance.now() - begin);
    }
    const entry = performance.getEntriesByType('navigation')[0];
    return {count: d.count, load: entry.domContentLoadedEventEnd, worst: Math.max(...times), middle: times.sort((a, b) => a - b)[30]};
  });
  console.log(`${count} ticks: shown after ${load.toFixed(0)} ms; a jump takes ${middle.toFixed(1)} ms, at most ${worst.toFixed(1)} ms`);
  assert.ok(count > 6000);
  // An idle machine needs a tenth of both.
  assert.ok(load < 5000, `shown after ${load} ms`);
  assert.ok(middle < 150, `${middle} ms a jump`);
}));

test('looks as it should on a laptop, in the dark, and on a phone', async () => {
  for (const [name, options] of [['laptop', {}], ['dark', {colorScheme: 'dark'}], ['phone', {viewport: {width: 390, height: 844}, deviceScaleFactor: 2}]]) {
    await withPage('drive.html', async (page) => {
      await page.evaluate(() => waymark.go(152));
      await page.waitForTimeout(100);
      await shot(page, name);
      const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
      assert.ok(wide[0] <= wide[1], `${name}: nothing sticks out to the right`);
      if (name !== 'phone') assert.ok(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight), `${name}: all is in sight`);
      for (const id of ['floor', 'play', 'strategy', 'scrub']) assert.ok(await page.locator(`#${id}`).isVisible(), `${name}: ${id}`);
    }, options);
  }
});

test('the floor is drawn, and drawn anew as the robot moves', () => withPage('drive.html', async (page) => {
  const ink = () => page.$eval('#floor', (canvas) => {
    const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    let sum = 0, drawn = 0;
    for (let i = 0; i < data.length; i += 4) sum = (sum * 31 + data[i] + data[i + 1] * 3 + data[i + 2] * 7) % 1000003, drawn += data[i + 3] > 0;
    return {sum, share: drawn / (data.length / 4)};
  });
  const first = await ink();
  assert.ok(first.share > 0.05);
  await page.keyboard.press('End');
  assert.notEqual((await ink()).sum, first.sum);
  const end = await ink();
  await page.keyboard.press('f');
  assert.equal(await page.getAttribute('#follow', 'aria-pressed'), 'true');
  assert.notEqual((await ink()).sum, end.sum);
  await page.click('#fit');
  assert.equal((await ink()).sum, end.sum);
  assert.ok(await shown(page) !== undefined);
}));
