// What holds at this tick: the strategy in large letters, facts as bars, satellites by level.

/// A new element: `make('button.fact', {title: 't'}, child, 'text')`.
function make(what, attributes = {}, ...children) {
  const [tag, ...classes] = what.split('.');
  const element = document.createElement(tag);
  if (classes.length) element.className = classes.join(' ');
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}
const byId = (id) => document.getElementById(id);
/// A button that explains; a mouse does not leave the focus on it, so that space goes on playing.
function onPress(button, act) {
  if (button.tagName === 'BUTTON') button.type = 'button';
  button.addEventListener('click', (event) => {
    if (event.detail > 0) button.blur();
    act(event);
  });
  return button;
}
function set(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/// A list of buttons as one stop of the tab key: the arrows up and down, Home and End move in it.
class Roving {
  /// `which` selects the buttons. A list of which only a part is there gets `follow(key)`, before Home and End and after the arrows.
  constructor(box, which, follow = () => {}) {
    this.box = box, this.which = which, this.follow = follow;
    box.addEventListener('focusin', (event) => { if (event.target.matches(which)) this.settle(event.target); });
    box.addEventListener('keydown', (event) => this.key(event));
  }
  buttons() { return [...this.box.querySelectorAll(this.which)].filter((one) => !one.closest('[hidden]')); }
  /// Makes `stop` the one that the tab key finds; else that of before, else the first.
  settle(stop) {
    const all = this.buttons(), one = stop || all.find((button) => button.tabIndex === 0) || all[0];
    for (const button of this.box.querySelectorAll(this.which)) button.tabIndex = button === one ? 0 : -1;
  }
  key(event) {
    const by = {ArrowUp: -1, ArrowDown: 1, Home: -Infinity, End: Infinity}[event.key];
    if (!by || event.ctrlKey || event.altKey || event.metaKey || !event.target.matches(this.which)) return;
    event.preventDefault(), event.stopPropagation();
    if (!Number.isFinite(by)) this.follow(event.key);
    const all = this.buttons(), to = Math.min(all.length - 1, Math.max(0, all.indexOf(event.target) + by));
    if (all.length) all[to].focus();
    if (Number.isFinite(by)) this.follow(event.key);
  }
}

class NowView {
  constructor(app) {
    this.app = app;
    onPress(byId('strategy'), (event) => this.app.choose({cell: this.app.drive.strategy.at(this.app.frame)}, event));
    onPress(byId('note'), () => { const note = this.last(); if (note) this.app.jump(note.frame); });
  }
  last() {
    const notes = this.app.drive.notes;
    return notes[countUpTo(notes.map((one) => one.frame), this.app.frame) - 1];
  }
  show(frame) {
    const drive = this.app.drive, name = drive.strategyName(frame), kind = drive.kindOf(frame);
    set(byId('strategy'), name || 'no strategy');
    byId('strategy').disabled = !name;
    set(byId('control'), name ? drive.cells[drive.strategy.at(frame)].control || '\u00a0' : '\u00a0');
    const swatch = byId('swatch').firstElementChild;
    swatch.setAttribute('stroke', lookColour(kind)), swatch.setAttribute('stroke-dasharray', kind.dash);
    this.showLeg(drive.leg.at(frame));
    const status = drive.status.at(frame), bad = status && !['ok', 'no_strategy'].includes(status);
    set(byId('status'), (bad ? '▲ ' : '') + (status || '–'));
    byId('status').className = bad ? 'status-bad' : '';
    const note = this.last();
    set(byId('note'), note ? `${drive.notes.indexOf(note) + 1}: ${note.text} (${clock(drive.t[note.frame])})` : 'none yet');
    byId('note').disabled = !note;
  }
  showLeg(name) {
    const leg = this.app.drive.legs.find((one) => one.name === name), place = byId('leg');
    const words = !name ? '–' : leg ? `${leg.from} → ${leg.to}` : name, key = words + (leg && leg.detour);
    if (place.dataset.key === key) return;
    place.dataset.key = key, place.title = name;
    place.replaceChildren(make('span.ends', {}, words), ...(leg && leg.detour ? [make('span.tag', {}, 'detour')] : []));
  }
}

/// The facts, those about landmarks last: there are many of them, and one or two matter at a time.
function factsInOrder(drive) {
  const marks = new Set(drive.picture.landmarks.map((mark) => mark.name)), facts = drive.cells.filter((cell) => cell.kind === kFact);
  return [...facts.filter((cell) => !marks.has(cell.name)), ...facts.filter((cell) => marks.has(cell.name))];
}

class FactsView {
  constructor(app) {
    this.app = app;
    this.rows = [];
    for (const cell of factsInOrder(app.drive)) {
      const sign = make('span.sign', {'aria-hidden': 'true'}), fill = make('i'), value = make('span.value');
      const button = onPress(make('button.fact', {title: cell.name}, sign, make('span.name', {}, cell.name), make('span.bar', {'aria-hidden': 'true'}, fill), value),
        (event) => app.choose({cell: cell.id}, event));
      button.dataset.cell = cell.id;
      const item = make('li', {}, button);
      byId('facts').append(item);
      this.rows.push({cell, item, button, sign, fill, value, key: ''});
    }
    this.roving = new Roving(byId('facts'), '.fact');
    byId('all-facts').addEventListener('change', () => this.filter());
    this.filter();
  }
  filter() {
    const all = byId('all-facts').checked || !this.rows.some((row) => this.app.drive.changes(row.cell));
    for (const row of this.rows) row.item.hidden = !all && !this.app.drive.changes(row.cell);
    this.roving.settle();
  }
  show(frame) {
    const drive = this.app.drive;
    for (const row of this.rows) {
      if (row.item.hidden) continue;
      const value = drive.value(row.cell.id, frame), seen = row.cell.seen.at(frame), fresh = row.cell.seen.since(frame) === frame;
      const awaited = row.cell.satellites.some((id) => drive.value(id, frame) >= drive.firing);
      const chosen = this.app.chosen && this.app.chosen.cell === row.cell.id, key = `${value} ${seen} ${fresh} ${awaited} ${chosen}`;
      if (key === row.key) continue;
      row.key = key;
      const size = Number.isFinite(value) ? Math.min(1, Math.abs(value)) * 50 : 0;
      row.fill.className = value < 0 ? 'minus' : '';
      row.fill.style.left = `${value < 0 ? 50 - size : 50}%`, row.fill.style.width = `${size}%`;
      set(row.value, certainty(value)), set(row.sign, seen ? '●' : awaited ? '◎' : '');
      row.button.className = `fact${seen ? ' seen' : ''}${value > 0 || awaited ? '' : ' quiet-fact'}${fresh ? ' fresh' : ''}${chosen ? ' chosen' : ''}`;
      row.button.setAttribute('aria-label', `${row.cell.name}: ${certainty(value)}${seen ? ', seen' : ''}${awaited ? ', awaited' : ''}`);
    }
  }
}

class SatellitesView {
  constructor(app) {
    this.app = app;
    this.chips = [];
    const levels = [...app.drive.levels, 'set by no rule'];
    const level = (cell) => Math.min(levels.length - 1, ...cell.writers.map((rule) => rule.level));
    const satellites = app.drive.cells.filter((cell) => cell.kind === kSatellite);
    levels.forEach((name, i) => {
      const here = satellites.filter((cell) => level(cell) === i);
      if (!here.length) return;
      const list = make('ul'), group = make('div', {}, make('h3', {}, name), list);
      for (const cell of here) {
        const chip = onPress(make('button.sat', {title: cell.name}, make('span.name', {}, cell.name)), (event) => app.choose({cell: cell.id}, event));
        chip.dataset.cell = cell.id;
        const item = make('li', {}, chip);
        list.append(item);
        this.chips.push({cell, item, chip, group, key: ''});
      }
      byId('satellites').append(group);
    });
    this.roving = new Roving(byId('satellites'), '.sat');
    byId('all-satellites').addEventListener('change', () => this.filter());
    this.filter();
  }
  filter() {
    const all = byId('all-satellites').checked;
    for (const one of this.chips) one.item.hidden = !all && !this.app.drive.changes(one.cell);
    for (const one of this.chips) one.group.hidden = !this.chips.some((other) => other.group === one.group && !other.item.hidden);
    this.roving.settle();
  }
  show(frame) {
    const drive = this.app.drive;
    for (const one of this.chips) {
      if (one.item.hidden) continue;
      const value = drive.value(one.cell.id, frame), fresh = one.cell.steps.since(frame) === frame;
      const chosen = this.app.chosen && this.app.chosen.cell === one.cell.id, key = `${value} ${fresh} ${chosen}`;
      if (key === one.key) continue;
      one.key = key;
      const part = !(value >= 1) && !(value <= -1);
      one.chip.className = `sat${value >= drive.firing ? ' high' : part ? ' part' : ''}${fresh ? ' fresh' : ''}${chosen ? ' chosen' : ''}`;
      set(one.chip.firstElementChild, part ? `${one.cell.name} ${certainty(value)}` : one.cell.name);
      one.chip.setAttribute('aria-label', `${one.cell.name}: ${certainty(value)}`);
    }
  }
}

function fillLegend(drive) {
  const line = (stroke, dash, width) => {
    const span = make('span');
    span.innerHTML = `<svg width="26" height="10" aria-hidden="true"><path d="M0 5h26" fill="none" stroke="${stroke}" stroke-width="${width}" stroke-dasharray="${dash}"/></svg>`;
    return span.firstChild;
  };
  const ran = drive.kinds.filter((kind, i) => drive.strategy.values.some((id) => id >= 0 && drive.cells[id].look === i));
  const items = ran.map((kind) => make('li', {}, line(lookColour(kind), kind.dash, 3), kind.name));
  if (drive.legs.length) items.push(make('li', {}, line(colour('blue') + '66', '', 7), 'route'));
  if (drive.legs.some((leg) => leg.detour)) items.push(make('li', {}, line(colour('orange') + '99', '6 4', 7), 'detour'));
  byId('legend').replaceChildren(...items);
}
