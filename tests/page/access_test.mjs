// Who has no mouse, or hears the page, or enlarges it: the keyboard keeps its place, what is said is said once, what is written can be read.
import {test} from 'node:test';
import assert from 'node:assert/strict';
import {browse, tick, truth, shot, until} from './browser.mjs';
import {contrast, themes, faintText} from './contrast.mjs';

const {withPage} = browse();
const go = (page, at) => page.evaluate((to) => waymark.go(to), at);
const firing = (name) => truth.findIndex((frame) => frame.fired.includes(name));
const spoken = (page) => page.textContent('#spoken');
/// What has the focus: its id, or the list it is in and its name.
const focus = (page) => page.evaluate(() => {
  const one = document.activeElement;
  return one.id || `${one.closest('[id]')?.id ?? one.tagName}: ${one.getAttribute('aria-label') || one.title || one.textContent}`;
});
const within = (page, id) => page.evaluate((box) => document.getElementById(box).contains(document.activeElement), id);
const small = {viewport: {width: 640, height: 400}};     // 1280x800 at 200 %

test('one place speaks, and not while it plays', () => withPage('drive.html', async (page) => {
  const live = 'output, [aria-live]:not([aria-live="off"]), [role="status"], [role="alert"], [role="log"], [role="timer"]';
  assert.deepEqual(await page.$$eval(live, (all) => all.map((one) => one.id)), ['spoken']);
  await page.focus('#scrub');
  await page.evaluate(() => {
    window.said = 0;
    const count = new MutationObserver((all) => { said += all.length; });
    count.observe(document.getElementById('spoken'), {childList: true, characterData: true, subtree: true});
    count.observe(document.getElementById('scrub'), {attributeFilter: ['aria-valuetext']});
  });
  await page.keyboard.press('Space');
  await until(page, () => waymark.frame > 10);
  assert.equal(await page.evaluate(() => said), 0);
  await page.keyboard.press('Space');
  assert.match(await spoken(page), /^tick \d+, /);
  assert.ok((await page.getAttribute('#scrub', 'aria-valuetext')).startsWith(`tick ${await tick(page) + 1} of`));
}));

test('who asks by the keyboard is led to the reason, hears it, and comes back', () => withPage('drive.html', async (page) => {
  const at = firing('arrive[Route1[LM1,LM5]]');
  await go(page, at);
  for (const [where, expected] of [['#facts button[title="LM5"]', /^LM5: fact, 0\.\d+ .*; Seen/], ['#satellites button[title="sat LM2"]', /^sat LM2: satellite, 1/],
    ['#strategy', /^Move\.\w+: strategy/], ['#history-names button[title="Move.mark"]', /^Move\.mark: strategy/], ['#log .row.current', /^.*: at .*; fired at this tick/]]) {
    await page.focus(where);
    const from = await focus(page);
    await page.keyboard.press('Enter');
    assert.equal(await focus(page), 'why-title', where);
    assert.match(await spoken(page), expected);
    assert.ok((await spoken(page)).startsWith(await page.textContent('#why-title')));
    await page.keyboard.press('ArrowRight');
    assert.equal(await focus(page), 'why-title', 'a step leaves it there');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Escape');
    assert.equal(await focus(page), from);
    assert.equal(await page.getAttribute('#tab-log', 'aria-selected'), 'true');
  }
  // Also while it plays, when reasons do not come with every tick.
  await page.evaluate(() => { waymark.player.play(), waymark.choose({cell: 0}), waymark.choose({cell: 1}); });
  assert.ok((await spoken(page)).startsWith(await page.evaluate(() => `${waymark.drive.cells[1].name}: `)));
}));

test('no button in the reasons loses the focus, whatever is explained', () => withPage('drive.html', async (page) => {
  await go(page, firing('go_round') + 2);
  const chosen = await page.evaluate(() => [...waymark.drive.cells.map((_, cell) => ({cell})), ...waymark.drive.rules.map((_, rule) => ({rule}))]
    .filter((_, i) => i % 5 === 0));
  const lost = await page.evaluate((all) => {
    const out = [], panel = document.getElementById('why-panel'), at = waymark.frame;
    const ask = (what) => { waymark.go(at), waymark.choose(what); return [...panel.querySelectorAll('button')]; };
    const key = (name) => document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key: name, bubbles: true, cancelable: true}));
    for (const what of all) {
      for (let i = 0; i < ask(what).length; ++i) {
        for (const act of [() => document.activeElement.click(), () => key('.'), () => key('ArrowLeft')]) {
          const button = ask(what)[i];
          if (button.disabled) continue;
          button.focus(), act();
          if (!panel.contains(document.activeElement)) out.push(`${JSON.stringify(what)}: ${button.textContent} by ${act}`);
        }
      }
    }
    return out;
  }, chosen);
  assert.deepEqual(lost, []);
  await page.focus('#why-panel');
  await page.keyboard.press('Escape');
  assert.equal(await focus(page), 'tab-log', 'nothing was asked by the keyboard');
}));

test('a list is one stop of the tab key; the arrows move in it', () => withPage('drive.html', async (page) => {
  await go(page, firing('go_round'));
  const stops = [];
  do { await page.keyboard.press('Tab'), stops.push(await focus(page)); } while (stops.length < 80 && !stops.slice(0, -1).includes(stops.at(-1)));
  for (const list of ['facts', 'satellites', 'history-names', 'log-rows']) assert.equal(stops.filter((stop) => stop.startsWith(`${list}: `)).length, 1, `${list} in ${stops.join('\n')}`);
  assert.ok(stops.length < 40, `${stops.length} stops`);
  const order = await page.$$eval('#history-names button', (all) => all.map((one) => one.title));
  await page.focus('#history-names button');
  const at = await tick(page), on = async (key, name) => { await page.keyboard.press(key), assert.ok((await focus(page)).endsWith(`: ${name}`), `${key}: ${await focus(page)}`); };
  await on('ArrowDown', order[1]), await on('ArrowDown', order[2]), await on('ArrowUp', order[1]), await on('End', order.at(-1)), await on('ArrowDown', order.at(-1)), await on('Home', order[0]);
  assert.equal(await tick(page), at, 'the drive stays where it is');
  await page.focus('#log .row.current');
  await page.keyboard.press('End');
  assert.equal(await page.evaluate(() => Number(document.activeElement.dataset.entry)), await page.evaluate(() => waymark.drive.log.length - 1));
  for (let i = 0; i < 40; ++i) await page.keyboard.press('ArrowUp');
  assert.equal(await page.evaluate(() => Number(document.activeElement.dataset.entry)), await page.evaluate(() => waymark.drive.log.length - 41));
  await page.evaluate(() => waymark.go(0));
  assert.ok(await within(page, 'log'), 'also if its row is far away');
}));

test('the first stops lead past the rest', () => withPage('drive.html#tick=96', async (page) => {
  for (const [n, to] of [[1, 'tab-log'], [2, 'by-turn'], [3, 'play']]) {
    await page.evaluate(() => { document.activeElement.blur(), getSelection().removeAllRanges(); });
    await page.focus(`.skips a:nth-child(${n})`);
    assert.ok((await page.locator('.skips a:focus').boundingBox()).height > 15, 'it can be seen');
    await page.keyboard.press('Enter');
    assert.equal(await focus(page), to);
  }
  assert.ok(page.url().endsWith('#tick=96'));
}));

test('what has the focus is not below the controls on an enlarged page', () => withPage('drive.html', async (page) => {
  await go(page, firing('go_round'));
  for (const key of ['Tab', 'Shift+Tab']) {
    const seen = new Set(), hidden = [];
    for (let i = 0; i < 60; ++i) {
      await page.keyboard.press(key);
      if (i % 3 === 0) await page.keyboard.press('ArrowDown');
      const [name, covered] = await page.evaluate(() => {
        const one = document.activeElement, box = one.getBoundingClientRect(), bar = document.getElementById('transport').getBoundingClientRect();
        return [one.id || one.textContent, !one.closest('#transport') && one !== document.body && box.height < 100 && box.bottom > bar.top + 1];
      });
      seen.add(name);
      if (covered) hidden.push(name);
    }
    assert.ok(seen.size > 20);
    assert.deepEqual(hidden, []);
  }
}, small));

test('a detour is told at every width', async () => {
  for (const width of [640, 910, 1280]) {
    await withPage('drive.html', async (page) => {
      await go(page, truth.findIndex((frame) => frame.leg === 'Route1[LM7,LM11]'));
      const tag = await page.locator('#leg .tag').boundingBox(), box = await page.locator('#leg').boundingBox();
      assert.ok(tag.width > 20 && tag.x + tag.width <= box.x + box.width + 0.5 && box.x + box.width <= width, `at ${width}: ${JSON.stringify([tag, box])}`);
      assert.ok(await page.$eval('#leg .ends', (ends) => ends.scrollWidth <= ends.clientWidth), `both ends at ${width}`);
    }, {viewport: {width, height: 512}});
  }
});

test('colours of words can be read on every ground, by light and in the dark', () => {
  const texts = ['ink', 'soft', 'faint', 'blue', 'orange'], weak = [];
  for (const [mode, colours] of Object.entries(themes())) {
    const pairs = [...texts.flatMap((text) => ['card', 'raise', 'ground', 'low'].map((ground) => [text, ground])), ['ink', 'blue-soft'], ['soft', 'blue-soft'],
      ['card', 'blue'], ['card', 'high'], ['ink', 'zero'], ['ink', 'orange-soft']];
    for (const [text, ground] of pairs) {
      const ratio = contrast(colours[text], colours[ground]);
      if (!(ratio >= 4.5)) weak.push(`${mode}: ${text} on ${ground}: ${ratio.toFixed(2)}`);
    }
  }
  assert.deepEqual(weak, []);
});

test('words that are shown can be read, by light and in the dark', async () => {
  for (const colorScheme of ['light', 'dark']) {
    await withPage('drive.html', async (page) => {
      for (const id of ['all-facts', 'all-satellites']) await page.check(`#${id}`);
      for (const at of [0, firing('go_round'), truth.length - 1]) {
        await go(page, at);
        assert.deepEqual(await page.evaluate(faintText), [], `${colorScheme}, rules at tick ${at + 1}`);
        await page.evaluate(() => waymark.choose({cell: waymark.drive.strategy.at(waymark.frame)}));
        assert.deepEqual(await page.evaluate(faintText), [], `${colorScheme}, reasons at tick ${at + 1}`);
        await page.evaluate(() => waymark.close());
      }
      await page.click('#help-open');
      assert.deepEqual(await page.evaluate(faintText), [], `${colorScheme}, keys`);
      await shot(page, `keys_${colorScheme}`);
    }, {colorScheme});
  }
});

test('Home and End scroll the reasons; letters and signs can be switched off', () => withPage('drive.html', async (page) => {
  await go(page, 150);
  await page.focus('#strategy'), await page.keyboard.press('Enter');
  await page.keyboard.press('End'), await page.keyboard.press('Home');
  assert.equal(await tick(page), 150);
  const follows = () => page.getAttribute('#follow', 'aria-pressed');
  await page.keyboard.press('f');
  assert.equal(await follows(), 'true');
  await page.click('#help-open'), await page.uncheck('#letters'), await page.click('#help .primary');
  for (const key of ['f', 's', '.', ',', '+', '?']) await page.keyboard.press(key);
  assert.equal(await follows(), 'true'), assert.equal(await tick(page), 150), assert.equal(await page.inputValue('#speed'), '1'), assert.ok(!await page.locator('#help').isVisible());
  await page.keyboard.press('ArrowRight');
  assert.equal(await tick(page), 151, 'the others go on acting');
  await page.reload();
  assert.ok(!await page.isChecked('#letters'), 'it is remembered');
}));

test('the labyrinth is enlarged and moved without a mouse', () => withPage('drive.html', async (page) => {
  const place = () => page.evaluate(() => { const {zoom, shiftX, shiftY} = waymark.floor; return [zoom, shiftX, shiftY]; });
  await page.click('#enlarge');
  assert.deepEqual(await place(), [1.25, 0, 0]);
  await page.click('#reduce');
  await page.focus('#floor');
  const at = await tick(page);
  await page.keyboard.press('+'), await page.keyboard.press('ArrowRight'), await page.keyboard.press('ArrowDown');
  assert.deepEqual(await place(), [1.25, -40, -40]);
  assert.equal(await tick(page), at), assert.equal(await page.inputValue('#speed'), '1');
  await page.keyboard.press('0');
  assert.deepEqual(await place(), [1, 0, 0]);
  await page.evaluate(() => document.activeElement.blur());
  const box = await page.locator('#floor').boundingBox();
  await page.mouse.click(box.x + 40, box.y + box.height / 2);
  await page.keyboard.press('ArrowRight');
  assert.equal(await tick(page), at + 1, 'a click into it takes the keys from nothing');
}));

test('every switch has a name of its own, and names are large enough for a finger where there is room', async () => {
  await withPage('drive.html', async (page) => {
    const names = await page.$$eval('input, select', (all) => all.map((one) => one.getAttribute('aria-label') || one.closest('label').textContent.trim()));
    assert.equal(new Set(names).size, names.length, names.join(', '));
    await page.uncheck('#history-facts');
    const room = await page.evaluate(() => (document.getElementById('history').clientHeight - 18) / waymark.history.cells.length);
    const high = (await page.locator('#history-names button').first().boundingBox()).height;
    assert.ok(Math.abs(high - Math.min(24, Math.max(16, Math.floor(room)))) < 0.1, `${high} of ${room}`);
  });
  await withPage('drive.html', async (page) => {
    for (const where of ['#history-names button', '.fact', '.sat', '.row']) assert.ok((await page.locator(`${where}:visible`).first().boundingBox()).height >= 24, where);
    // A click into the history still finds its row.
    await page.locator('#cells').click({position: {x: 3, y: 18 + 2 * 24 + 12}});
    assert.equal(await page.textContent('#why-title'), await page.getAttribute('#history-names button:nth-child(3)', 'title'));
  }, {viewport: {width: 390, height: 844}});
});
