// The recording as sim/report/data.h writes it, unpacked: what was so at a frame, since when, and what fired.

const kFact = 0, kSatellite = 1, kStrategy = 2;

/// Sums differences up again; what is unknown is NaN.
function undelta(column, scale) {
  let last = 0;
  return column.map((d) => (d === null ? NaN : (last += d) / scale));
}

/// The number of items of ascending `sorted` that are at most `x`.
function countUpTo(sorted, x) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= x) low = middle + 1;
    else high = middle;
  }
  return low;
}

/// A value that changes at some frames and stays in between.
class Steps {
  constructor(initial) {
    this.initial = initial;
    this.frames = [];
    this.values = [];
  }
  push(frame, value) {
    if (Object.is(this.frames.length ? this.values[this.values.length - 1] : this.initial, value)) return;
    this.frames.push(frame);
    this.values.push(value);
  }
  at(frame) {
    const n = countUpTo(this.frames, frame);
    return n === 0 ? this.initial : this.values[n - 1];
  }
  /// The frame of the change that is in force at `frame`; -1: as it was at start.
  since(frame) {
    const n = countUpTo(this.frames, frame);
    return n === 0 ? -1 : this.frames[n - 1];
  }
  /// The frame of the next change, -1 if there is none.
  next(frame) {
    const n = countUpTo(this.frames, frame);
    return n < this.frames.length ? this.frames[n] : -1;
  }
}

class Drive {
  constructor(data) {
    const p = data.picture;
    const points = (all) => all.map(([x, y]) => ({x: x / 1e3, y: y / 1e3}));
    const strokes = (all) => all.map(([x1, y1, x2, y2, w]) => ({x1: x1 / 1e3, y1: y1 / 1e3, x2: x2 / 1e3, y2: y2 / 1e3, w: (w || 0) / 1e3}));
    this.title = data.title;
    this.outcome = '';
    this.picture = {
      low: points([p.low])[0], high: points([p.high])[0], radius: (p.radius || 0) / 1e3,
      landmarks: p.landmarks.map(([name, x, y]) => ({name, x: x / 1e3, y: y / 1e3})),
      roads: p.roads.map(([name, from, to, kind, width, along]) => ({name, from, to, kind, width: (width || 0) / 1e3, along: points(along)})),
      halls: p.halls.map(([width, along]) => ({width: (width || 0) / 1e3, along: points(along)})), blocks: p.blocks.map(points),
      lines: strokes(p.lines), stops: strokes(p.stops), walls: strokes(p.walls),
    };
    this.kinds = data.kinds.map(([name, light, dark, dash]) => ({name, light, dark, dash}));
    this.noKind = {name: 'no strategy', light: data.noLook[0], dark: data.noLook[1], dash: data.noLook[2]};
    this.levels = data.levels;
    this.cells = data.cells.map(([name, kind, initial, flags, look, control, satellites, plain, attended], id) => ({
      id, name, kind, initial: initial / 1e4, command: !!(flags & 1), keep: !!(flags & 2), look, control, satellites, plain: plain / 1e4, attended: attended / 1e4,
      steps: new Steps(initial / 1e4), seen: new Steps(false), writers: []}));
    this.rules = data.rules.map(([name, level, at, condition, writes, clears, flags], id) => {
      const pairs = [];
      for (let i = 0; i < writes.length; i += 2) pairs.push({cell: writes[i], value: writes[i + 1] / 1e4});
      return {id, name, level, at, condition, writes: pairs, clears, reset: !!(flags & 1), eachTick: !!(flags & 2), first: [], last: []};
    });
    this.conditions = data.conditions;
    this.groups = data.groups;
    this.firing = data.firing / 1e4;
    this.legs = data.legs.map(([name, from, to, road, detour]) => ({name, from, to, road, detour: !!detour, used: -1}));
    for (const rule of this.rules) {
      for (const write of rule.writes) this.cells[write.cell].writers.push(rule);
    }
    this.count = 0;
    this.t = [], this.x = [], this.y = [], this.h = [];
    this.senses = {line: [[], [], [], [], []], range: [[], [], [], [], [], [], [], []], compass: [], x: [], y: [], speed: [], touched: []};
    this.strategy = new Steps(-1), this.status = new Steps(''), this.leg = new Steps('');
    this.log = [];        // {rule, first, last}: a rule fired at each of these frames
    this.fired = [];      // by frame: rules
    this.notes = [];      // {frame, text}
    this.stays = [];
    this.turns = [];      // frames at which a satellite or the strategy changed, or something was seen or lost
  }

  /// Where the wheels say that the robot is: they count from where they were heard first. Null if they say nothing.
  byWheels(frame) {
    const s = this.senses, known = (i) => Number.isFinite(s.x[i] + s.y[i] + this.x[i] + this.y[i]);
    const first = known(frame) ? s.x.findIndex((_, i) => known(i)) : -1;
    return first < 0 ? null : {x: s.x[frame] - s.x[first] + this.x[first], y: s.y[frame] - s.y[first] + this.y[first]};
  }

  /// Takes the next frames; returns false if they do not go on where the last ones ended.
  append(chunk) {
    if (chunk.first !== this.count) return false;
    const unknown = new Array(chunk.count).fill(NaN);
    const take = (into, column, scale) => { for (const v of column.length ? undelta(column, scale) : unknown) into.push(v); };
    take(this.t, chunk.t, 1e4), take(this.x, chunk.x, 1e3), take(this.y, chunk.y, 1e3), take(this.h, chunk.h, 1e3);
    const s = chunk.senses;
    s.line.forEach((column, i) => take(this.senses.line[i], column, 1e2));
    s.range.forEach((column, i) => take(this.senses.range[i], column, 1e2));
    for (const name of ['compass', 'x', 'y', 'speed']) take(this.senses[name], s[name], 1e3);
    take(this.senses.touched, s.touched, 1);
    this.count += chunk.count;
    this.outcome = chunk.outcome;
    this.appendChanges(chunk);
    this.appendFirings(chunk);
    this.stays = chunk.stays.map(([kind, name, from, to, first, last]) => ({kind, name, x1: from[0] / 1e3, y1: from[1] / 1e3, x2: to[0] / 1e3, y2: to[1] / 1e3, first, last}));
    return true;
  }

  appendChanges(chunk) {
    const turns = new Set();
    const steps = (into, [frames, values]) => undelta(frames, 1).forEach((frame, i) => into.push(frame, values[i]));
    for (const [id, frames, values] of chunk.changes) {
      const cell = this.cells[id], at = undelta(frames, 1), to = undelta(values, 1e4);
      at.forEach((frame, i) => cell.steps.push(frame, to[i]));
      if (cell.kind !== kFact) at.forEach((frame) => turns.add(frame));
    }
    steps(this.strategy, chunk.strategy), steps(this.status, chunk.status), steps(this.leg, chunk.leg);
    for (const leg of this.legs) {
      if (leg.used < 0) leg.used = this.leg.frames[this.leg.values.indexOf(leg.name)] ?? -1;
    }
    if (chunk.first === 0) this.settle();
    const toggles = [];
    const sight = ([frames, lists], seen) => undelta(frames, 1).forEach((frame, i) => lists[i].forEach((id) => toggles.push({frame, id, seen})));
    sight(chunk.lost, false), sight(chunk.events, true);
    for (const {frame, id, seen} of toggles.sort((a, b) => a.frame - b.frame)) {
      turns.add(frame);
      const steps = this.cells[id] && this.cells[id].seen;
      if (!steps) continue;
      if (!steps.frames.length) steps.initial = !seen;
      steps.push(frame, seen);
    }
    undelta(chunk.notes[0], 1).forEach((frame, i) => chunk.notes[1][i].forEach((text) => this.notes.push({frame, text})));
    this.strategy.frames.forEach((frame) => { if (frame >= chunk.first) turns.add(frame); });
    if (chunk.first === 0 && chunk.count) turns.add(0);
    for (const frame of [...turns].sort((a, b) => a - b)) this.turns.push(frame);
  }

  /// The first tick settles what is seen, and makes no event.
  settle() {
    for (const cell of this.cells) {
      if (cell.kind !== kFact) continue;
      const attended = cell.satellites.some((id) => this.cells[id].initial >= this.firing);
      cell.seen.initial = cell.steps.at(0) > (attended ? cell.attended : cell.plain);
    }
  }
  appendFirings(chunk) {
    while (this.fired.length < this.count) this.fired.push([]);
    const [rules, firsts, lengths] = chunk.firings.map((column) => undelta(column, 1));
    rules.forEach((id, i) => {
      const rule = this.rules[id], first = firsts[i], last = first + lengths[i];
      for (let frame = first; frame < last; ++frame) this.fired[frame].push(id);
      const open = rule.last.length - 1;
      if (open >= 0 && rule.last[open] === first) {      // it went on from the chunk before
        rule.last[open] = last;
        for (let k = this.log.length - 1; k >= 0; --k) if (this.log[k].rule === id) { this.log[k].last = last; break; }
      } else {
        rule.first.push(first), rule.last.push(last);
        this.log.push({rule: id, first, last});
      }
    });
    for (let frame = chunk.first; frame < this.count; ++frame) this.fired[frame].sort((a, b) => a - b);
  }

  firedAt(rule, frame) {
    const n = countUpTo(rule.first, frame);
    return n > 0 && frame < rule.last[n - 1];
  }
  /// The last frame up to `frame` at which the rule fired, -1: never.
  lastFiring(rule, frame) {
    const n = countUpTo(rule.first, frame);
    return n === 0 ? -1 : Math.min(frame, rule.last[n - 1] - 1);
  }
  /// The first frame after `frame` at which it fires, -1: never.
  nextFiring(rule, frame) {
    const n = countUpTo(rule.first, frame);
    if (n > 0 && frame + 1 < rule.last[n - 1]) return frame + 1;
    return n < rule.first.length ? rule.first[n] : -1;
  }

  value(id, frame) { return this.cells[id].steps.at(frame); }
  kindOf(frame) {
    const id = this.strategy.at(frame);
    return id < 0 || !this.cells[id] || this.cells[id].look < 0 ? this.noKind : this.kinds[this.cells[id].look];
  }
  strategyName(frame) {
    const id = this.strategy.at(frame);
    return id < 0 || !this.cells[id] ? '' : this.cells[id].name;
  }
  frameAt(time) { return Math.max(0, countUpTo(this.t, time) - 1); }
  changes(cell) { return cell.steps.frames.length > 0; }

  /// What a rule writes to a cell: undefined if nothing.
  writeOf(rule, id) {
    const write = rule.writes.find((one) => one.cell === id);
    if (write) return write.value;
    if (rule.clears.some((group) => this.groups[group].includes(id))) return -1;
    const cell = this.cells[id];
    return rule.reset && cell.kind === kSatellite && !cell.keep ? cell.initial : undefined;
  }
  /// The rules that fired at this frame and wrote the cell, in order.
  writersAt(id, frame) { return (this.fired[frame] || []).map((r) => this.rules[r]).filter((rule) => this.writeOf(rule, id) !== undefined); }
}
