// Why a cell has its value at this tick, and why a rule fired or did not.

const kMostRaisers = 4;

class WhyView {
  constructor(app) {
    this.app = app, this.drive = app.drive, this.conditions = app.conditions;
    this.panel = byId('why-panel'), this.title = byId('why-title'), this.body = byId('why-body');
    this.key = '', this.last = 0;
  }
  show(frame) {
    if (this.panel.hidden) return;
    const chosen = this.app.chosen, key = chosen ? `${chosen.cell} ${chosen.rule} ${frame}` : '';
    if (key === this.key && key) return;
    // Reasons cannot be read in a film: while it plays they come four times a second.
    if (this.app.player.playing && chosen && performance.now() - this.last < 250) return;
    this.key = key, this.last = performance.now();
    if (!chosen || !this.drive.count) {
      this.fill('', [make('p.empty', {}, 'Choose a fact, a satellite, a strategy or a rule: here stands why it is so at this tick.')]);
    } else if (chosen.rule !== undefined) {
      this.fill(this.drive.rules[chosen.rule].name, this.rule(this.drive.rules[chosen.rule], frame));
    } else {
      this.fill(this.drive.cells[chosen.cell].name, this.cell(this.drive.cells[chosen.cell], frame));
    }
  }
  /// Puts a new explanation in the place of the old one. The focus stays on the button that says the same, or goes to the title:
  /// a button that is taken away would leave it at the beginning of the page.
  fill(title, parts) {
    const named = (button) => button.getAttribute('aria-label') || button.textContent;
    const alike = (one) => [...this.body.querySelectorAll('button')].filter((button) => named(button) === named(one));
    const old = this.body.contains(document.activeElement) ? document.activeElement : null, place = old ? alike(old).indexOf(old) : -1;
    set(this.title, title), this.title.hidden = !title;
    this.body.replaceChildren(...parts);
    if (!old) return;
    const again = alike(old)[place];
    (again && !again.disabled ? again : this.title).focus({preventScroll: true});
  }
  /// The explanation in a breath, for who does not see it.
  inShort() {
    return `${this.title.textContent}: ${[...this.body.querySelectorAll(':scope > p')].slice(0, 2).map((p) => p.textContent.replace(/[●○◎✓✗] ?/g, '')).join('; ')}`;
  }

  tick(frame) { return `tick ${frame + 1} (${clock(this.drive.t[frame])})`; }
  jump(label, frame) {
    const button = onPress(make('button', {}, label), () => this.app.jump(frame));
    button.disabled = frame < 0;
    return button;
  }
  name(cell) { return onPress(make('button.link', {}, cell.name), (event) => this.app.choose({cell: cell.id}, event)); }

  cell(cell, frame) {
    const words = {[kFact]: cell.command ? 'command' : 'fact', [kSatellite]: 'satellite', [kStrategy]: 'strategy'}[cell.kind];
    const value = cell.steps.at(frame), since = cell.steps.since(frame);
    const parts = [make('p', {}, make('span.is', {}, `${words}, `), make('span.large', {'data-value': certainty(value)}, certainty(value)),
      since < 0 ? ' since the start' : since === frame ? ' from this tick on' : ` since ${this.tick(since)}, for ${duration(+(this.drive.t[frame] - this.drive.t[since]).toFixed(3))}`)];
    if (since >= 0) {
      parts.push(make('div.jumps', {}, this.jump('◂ when it became so', since), this.jump('next change ▸', cell.steps.next(frame))));
    } else if (cell.steps.next(frame) >= 0) {
      parts.push(make('div.jumps', {}, this.jump('next change ▸', cell.steps.next(frame))));
    }
    if (cell.kind === kFact) parts.push(...this.fact(cell, frame, value));
    else if (cell.kind === kSatellite) parts.push(...this.satellite(cell, frame, value, since));
    else parts.push(...this.strategy(cell, frame));
    return parts;
  }

  fact(cell, frame, value) {
    const seen = cell.seen.at(frame), since = cell.seen.since(frame);
    const high = cell.satellites.filter((id) => this.drive.value(id, frame) >= this.drive.firing).map((id) => this.drive.cells[id]);
    const bound = high.length || seen ? cell.attended : cell.plain;
    const parts = [make('p', {}, seen ? `● Seen${since < 0 ? ' since the start' : ` since ${this.tick(since)}`}; it stays seen above ${certainty(cell.attended)}.`
      : `Not seen: ${certainty(value)} is not above ${certainty(bound)}${high.length ? ', the threshold of what is awaited' : ''}.`)];
    parts.push(make('p', {}, high.length ? '◎ Awaited: ' : 'Not awaited.', ...high.flatMap((one, i) => (i ? [', ', this.name(one)] : [this.name(one)])), high.length ? ' is high.' : ''));
    parts.push(make('p.at', {}, cell.command ? 'An operator gives it.' : 'The sensors say so; rules do not set facts.'));
    return parts;
  }

  satellite(cell, frame, value, since) {
    const parts = [make('h4', {}, since < 0 ? 'Set by' : `Set at ${this.tick(since)} by`)];
    const writers = since < 0 ? [] : this.drive.writersAt(cell.id, since);
    if (since < 0) parts.push(make('p', {}, 'nothing yet: it has its initial value.'));
    else if (!writers.length) parts.push(make('p', {}, 'a rule that the recording does not name.'));
    for (const rule of writers) parts.push(this.box(rule, since, this.effectOn(rule, cell)));
    if (value >= this.drive.firing) return parts;
    const raisers = cell.writers.filter((rule) => rule.condition >= 0 && this.drive.writeOf(rule, cell.id) > 0)
      .map((rule) => ({rule, lacks: this.conditions.lacking(rule.condition, frame, rule.level)})).sort((a, b) => a.lacks - b.lacks || a.rule.id - b.rule.id);
    if (!raisers.length) return parts;
    parts.push(make('h4', {}, `What would raise it, the nearest first${raisers.length > kMostRaisers ? ` (${kMostRaisers} of ${raisers.length})` : ''}`));
    for (const {rule} of raisers.slice(0, kMostRaisers)) parts.push(this.box(rule, frame, this.effectOn(rule, cell)));
    return parts;
  }

  strategy(cell, frame) {
    const drive = this.drive, now = drive.strategy.at(frame), runs = now === cell.id;
    const parts = [make('p', {}, runs ? '● It runs.' : 'It does not run', ...(runs || now < 0 ? [runs ? '' : '; none does.'] : ['; ', this.name(drive.cells[now]), ' does.']))];
    if (cell.control) parts.push(make('p', {}, make('code', {}, cell.control)));
    for (const id of cell.satellites) {
      const wanted = drive.value(id, frame) >= drive.firing;
      parts.push(make('p', {}, make(wanted ? 'span.holds' : 'span.fails', {'aria-hidden': 'true'}, wanted ? '✓' : '✗'), wanted ? 'wanted: ' : 'not wanted: ', this.name(drive.cells[id]), ` is ${certainty(drive.value(id, frame))}`));
      for (const rule of drive.writersAt(id, Math.max(0, drive.cells[id].steps.since(frame)))) {
        parts.push(make('h4', {}, `Set at ${this.tick(drive.cells[id].steps.since(frame))} by`), this.box(rule, drive.cells[id].steps.since(frame), this.effectOn(rule, drive.cells[id])));
      }
    }
    const last = drive.levels.length - 1;
    const own = drive.rules.filter((rule) => rule.level === last && rule.writes.some((write) => write.cell === cell.id && write.value > 0));
    if (own.length) parts.push(make('h4', {}, 'The control level'));
    for (const rule of own) parts.push(this.box(rule, frame, ''));
    return parts;
  }

  /// A rule with its place, its effect, and its condition as it was at a frame.
  box(rule, frame, effect) {
    const head = make('p', {}, onPress(make('button.link', {}, rule.name), (event) => this.app.choose({rule: rule.id}, event)), make('span.is', {}, ` at ${this.drive.levels[rule.level] ?? '?'}`));
    const box = make('div.rule-box', {}, head);
    if (effect) box.append(make('p', {}, 'then ', make('code', {}, effect)));
    if (rule.condition >= 0) box.append(make('ul.tree', {'aria-label': 'Conditions'}, this.tree(rule.condition, frame, rule.level, true)));
    if (rule.at) box.append(make('p.at', {}, make('code', {}, rule.at)));
    return box;
  }

  rule(rule, frame) {
    const drive = this.drive, fires = drive.firedAt(rule, frame), last = drive.lastFiring(rule, frame), next = drive.nextFiring(rule, frame);
    const parts = [make('p.at', {}, `at ${drive.levels[rule.level] ?? '?'}${rule.eachTick ? ', fires while it holds' : ', fires when it becomes true'}`)];
    parts.push(make('p', {}, make('b', {}, fires ? '● fired at this tick' : last < 0 ? '○ has not fired yet' : `○ not now; last fired at ${this.tick(last)}`)));
    parts.push(make('div.jumps', {}, this.jump('◂ last time', fires ? drive.lastFiring(rule, frame - 1) : last), this.jump('next time ▸', next)));
    if (rule.condition >= 0) {
      const holds = this.conditions.holds(rule.condition, frame, rule.level);
      parts.push(make('h4', {}, holds && !fires && !rule.eachTick ? 'Its condition holds, as it did before: it fires only when it becomes true' : 'Its condition at this tick'));
      parts.push(make('ul.tree', {'aria-label': 'Conditions'}, this.tree(rule.condition, frame, rule.level, true)));
    }
    parts.push(make('h4', {}, 'What it does'), make('ul', {}, ...this.effects(rule)));
    if (rule.at) parts.push(make('h4', {}, 'Written in'), make('p', {}, make('code', {}, rule.at)));
    return parts;
  }

  effectOn(rule, cell) {
    const write = rule.writes.find((one) => one.cell === cell.id);
    if (write) return this.effect(write.value, cell.name);
    return rule.clears.some((group) => this.drive.groups[group].includes(cell.id)) ? `−${cell.name} (one of its group at most is high)` : 'reset';
  }
  effect(value, name) { return value === 1 ? `+${name}` : value === -1 ? `−${name}` : `${name} = ${certainty(value)}`; }
  effects(rule) {
    const items = rule.writes.map((write) => make('li', {}, make('code', {}, this.effect(write.value, '')), this.name(this.drive.cells[write.cell])));
    for (const group of rule.clears) {
      const cells = this.drive.groups[group].map((id) => this.drive.cells[id].name);
      items.push(make('li', {}, make('code', {}, '−'), cells.length > 4 ? `all others of ${cells.slice(0, 3).join(', ')}, … (${cells.length})` : `all others of ${cells.join(', ')}`));
    }
    if (rule.reset) items.push(make('li', {}, make('code', {}, 'reset'), ': every satellite to its initial value'));
    return items.length ? items : [make('li.is', {}, 'nothing')];
  }

  /// One condition and what it is made of; `wanted` turns below a `not`.
  tree(index, frame, level, wanted) {
    const [op, what, more] = this.drive.conditions[index], holds = this.conditions.holds(index, frame, level), good = holds === wanted;
    const sign = make(good ? 'span.holds' : 'span.fails', {role: 'img', 'aria-label': good ? 'holds' : 'does not hold'}, good ? '✓' : '✗');
    const item = make(good ? 'li' : 'li.not', {}, sign);
    if (op === kAnd && what.length > 1) item.append('all of', make('ul', {}, ...what.map((child) => this.tree(child, frame, level, wanted))));
    else if (op === kOr && what.length > 1) item.append('one of', make('ul', {}, ...what.map((child) => this.tree(child, frame, level, wanted))));
    else if (op === kNot && [kAnd, kOr, kFor].includes(this.drive.conditions[what[0]][0])) item.append('not', make('ul', {}, this.tree(what[0], frame, level, !wanted)));
    else if (op === kFor) item.append(`for ${duration(more / 1e4)}`, this.heldFor(what[0], frame, level), make('ul', {}, this.tree(what[0], frame, level, wanted)));
    else item.append(make('span.said', {}, this.conditions.words(index)), ...this.read(op === kNot ? what[0] : index, frame, level));
    return item;
  }
  heldFor(index, frame, level) {
    const held = this.conditions.heldFor(index, frame, level);
    return make('span.is', {}, held < 0 ? ': has not begun' : `: holds for ${duration(+held.toFixed(3))} by now`);
  }
  read(index, frame, level) {
    const [op, what] = this.drive.conditions[index];
    if (![kIs, kSeen, kEvent, kLost].includes(op)) return [];
    const cell = this.drive.cells[what], value = this.conditions.valueFor(what, frame, level);
    const link = onPress(make('button.link', {title: `Why ${cell.name}?`, 'aria-label': `Why ${cell.name}?`}, certainty(value)), (event) => this.app.choose({cell: cell.id}, event));
    return [make('span.is', {}, ': '), link];
  }
}
