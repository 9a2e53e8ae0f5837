// Conditions of rules, evaluated again: the same terms and the same order of levels as in the engine (docs/language.md, "The
// tick"), over the recorded values.

const kAnd = 0, kOr = 1, kNot = 2, kFor = 3, kEvent = 4, kLost = 5, kSeen = 6, kIs = 7;
const kTerms = ['low', 'zero', 'high'];

class Conditions {
  constructor(drive) { this.drive = drive; }

  /// The value of a cell as rules of `level` read it at `frame`: what the levels above it wrote at this tick counts.
  valueFor(id, frame, level) {
    const drive = this.drive, cell = drive.cells[id];
    if (cell.kind === kFact) return cell.steps.at(frame);
    let value = frame === 0 ? cell.initial : cell.steps.at(frame - 1);
    if (cell.kind === kStrategy) return level === drive.levels.length - 1 ? -1 : value;
    for (const r of drive.fired[frame] || []) {
      const rule = drive.rules[r];
      if (rule.level >= level) break;
      const write = drive.writeOf(rule, id);
      if (write !== undefined) value = write;
    }
    return value;
  }

  inTerm(value, term) {
    const degree = term === 2 ? Math.max(0, value) : term === 0 ? Math.max(0, -value) : 1 - Math.abs(value);
    return degree >= this.drive.firing;
  }

  holds(index, frame, level) {
    const [op, what, more] = this.drive.conditions[index];
    switch (op) {
      case kAnd: return what.every((child) => this.holds(child, frame, level));
      case kOr: return what.some((child) => this.holds(child, frame, level));
      case kNot: return !this.holds(what[0], frame, level);
      case kFor: return this.heldFor(what[0], frame, level, more / 1e4) >= more / 1e4 - 1e-9;
      case kEvent: return this.drive.cells[what].seen.since(frame) === frame && this.drive.cells[what].seen.at(frame);
      case kLost: return this.drive.cells[what].seen.since(frame) === frame && !this.drive.cells[what].seen.at(frame);
      case kSeen: return this.drive.cells[what].seen.at(frame);
      default: return this.inTerm(this.valueFor(what, frame, level), more);
    }
  }

  /// For how many seconds a condition has held by now, -1: it does not. Looks back for `enough` seconds at most.
  heldFor(index, frame, level, enough = 120) {
    const t = this.drive.t;
    let first = frame;
    if (!this.holds(index, frame, level)) return -1;
    while (first > 0 && t[frame] - t[first] < enough && this.holds(index, first - 1, level)) --first;
    return t[frame] - t[first];
  }

  /// The condition in the language's own words, as one line.
  words(index, within = kOr) {
    const [op, what, more] = this.drive.conditions[index];
    const name = () => this.drive.cells[what].name;
    switch (op) {
      case kAnd: return what.length ? what.map((child) => this.words(child, kAnd)).join(' and ') : 'always';
      case kOr: {
        const text = what.length ? what.map((child) => this.words(child, kOr)).join(' or ') : 'never';
        return within === kOr || what.length < 2 ? text : `(${text})`;
      }
      case kNot: return `not ${this.wordsInside(what[0])}`;
      case kFor: return `${this.wordsInside(what[0])} for ${duration(more / 1e4)}`;
      case kEvent: return `event ${name()}`;
      case kLost: return `lost ${name()}`;
      case kSeen: return `seen ${name()}`;
      default: return more === 2 ? name() : `${name()} is ${kTerms[more]}`;
    }
  }
  wordsInside(index) {
    const op = this.drive.conditions[index][0];
    return op === kAnd || op === kOr ? `(${this.words(index)})` : this.words(index, kNot);
  }

  /// How many single conditions would have to change for this to hold, at least.
  lacking(index, frame, level, wanted = true) {
    const [op, what] = this.drive.conditions[index];
    if (op === kNot) return this.lacking(what[0], frame, level, !wanted);
    if (op === kAnd || op === kOr) {
      const each = what.map((child) => this.lacking(child, frame, level, wanted));
      if ((op === kAnd) === wanted) return each.reduce((a, b) => a + b, 0);
      return each.length ? Math.min(...each) : 1e6;
    }
    return this.holds(index, frame, level) === wanted ? 0 : 1;
  }
}

function duration(seconds) {
  return seconds < 1 ? `${Math.round(seconds * 1000)} ms` : `${+seconds.toFixed(3)} s`;
}
/// A certainty as people write it: -1, 0, 0.8; an unknown one as `?`.
function certainty(value) {
  return Number.isFinite(value) ? String(+value.toFixed(2)).replace('-', '−') : '?';
}
function clock(seconds) {
  if (!Number.isFinite(seconds)) return '?';
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${(seconds - 60 * minutes).toFixed(1).padStart(4, '0')}`;
}
