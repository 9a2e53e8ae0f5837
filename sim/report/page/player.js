// Time: playing, stepping, the bar with the strategies and notes on it, keys.

const kSpeeds = [0.25, 0.5, 1, 2, 4, 8, 16, 32];

class Player {
  constructor(app) {
    this.app = app;
    this.playing = false;
    this.time = 0;                    // seconds of the drive
    this.speed = 1;
    this.bar = byId('scrub'), this.bands = byId('bands');
    onPress(byId('play'), () => this.toggle());
    onPress(byId('home'), () => this.step(-Infinity)), onPress(byId('end'), () => this.step(Infinity));
    onPress(byId('back'), (event) => this.step(event.shiftKey ? -10 : -1)), onPress(byId('forward'), (event) => this.step(event.shiftKey ? 10 : 1));
    this.bar.addEventListener('input', () => this.app.go(Number(this.bar.value)));
    byId('speed').addEventListener('change', () => { this.speed = Number(byId('speed').value); });
    document.addEventListener('keydown', (event) => this.key(event));
    this.letters();
    new ResizeObserver(() => this.drawBands()).observe(this.bands);
    // On a small page the controls lie over its end; what has the focus must not be below them.
    const controls = byId('transport');
    new ResizeObserver(() => document.documentElement.style.setProperty('--bar', `${controls.offsetHeight}px`)).observe(controls);
    dark.addEventListener('change', () => this.drawBands());
  }

  /// Who speaks to the machine, or hits keys by chance, can do without keys that are letters or signs. The browser remembers that
  /// if it may.
  letters() {
    const box = byId('letters'), kKey = 'waymark.letters';
    try { box.checked = localStorage.getItem(kKey) !== 'off'; } catch { /* nothing is remembered */ }
    box.addEventListener('change', () => { try { localStorage.setItem(kKey, box.checked ? 'on' : 'off'); } catch { /* nor here */ } });
  }

  last() { return Math.max(0, this.app.drive.count - 1); }
  toggle() { this.playing ? this.pause() : this.play(); }
  play() {
    if (!this.app.drive.count) return;
    if (this.app.frame >= this.last() && !this.app.live) this.app.go(0);
    this.playing = true;
    this.button();
    let before = performance.now();
    const turn = (now) => {
      if (!this.playing) return;
      this.advance((now - before) / 1000 * this.speed);
      before = now;
      if (this.playing) requestAnimationFrame(turn);
    };
    requestAnimationFrame(turn);
  }
  advance(seconds) {
    const t = this.app.drive.t, end = t[this.last()];
    this.time = Math.min(this.time + seconds, end);
    if (this.time >= end && !this.app.live) {
      this.pause(), this.app.go(this.last());
      return;
    }
    const frame = this.app.drive.frameAt(this.time), next = t[frame + 1];
    this.app.show(frame, next > t[frame] ? Math.min(1, (this.time - t[frame]) / (next - t[frame])) : 0);
  }
  pause() {
    this.playing = false;
    this.button();
    this.app.why.show(this.app.frame);
    this.tell(this.app.frame);
    this.app.speak();
  }
  button() {
    const button = byId('play');
    button.querySelector('path').setAttribute('d', this.playing ? 'M3 2h4v12H3zM9 2h4v12H9z' : 'M4 2v12l10-6z');
    button.setAttribute('aria-label', this.playing ? 'Pause' : 'Play');
  }
  step(by) {
    if (this.playing) this.pause();
    this.app.go(Math.min(this.last(), Math.max(0, this.app.frame + by)));
    this.app.speak();
  }
  /// To the next tick at which something changed, or to the one before.
  turn(on) {
    const turns = this.app.drive.turns, n = countUpTo(turns, this.app.frame);
    const to = on ? turns[n] : turns[turns[n - 1] === this.app.frame ? n - 2 : n - 1];
    if (to !== undefined) this.step(to - this.app.frame);
  }
  faster(by) {
    const at = Math.min(kSpeeds.length - 1, Math.max(0, kSpeeds.indexOf(this.speed) + by));
    this.speed = kSpeeds[at], byId('speed').value = String(this.speed);
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || byId('help').open) return;
    const where = event.target, pressed = event.key;
    if (pressed === ' ' && (where.tagName === 'BUTTON' || where.type === 'checkbox')) return;   // it presses what has the focus
    if (pressed.length === 1 && pressed !== ' ' && !byId('letters').checked) return;
    if (['Home', 'End'].includes(pressed) && where.closest('.scroll')) return;   // to its own beginning and end
    if (where.tagName === 'SELECT' || (where.type === 'range' && where !== this.bar)) return;
    const far = event.shiftKey ? 10 : 1;
    const keys = {
      ' ': () => this.toggle(), ArrowLeft: () => this.step(-far), ArrowRight: () => this.step(far), Home: () => this.step(-Infinity), End: () => this.step(Infinity),
      '+': () => this.faster(1), '=': () => this.faster(1), '-': () => this.faster(-1), '_': () => this.faster(-1), ',': () => this.turn(false), '.': () => this.turn(true),
      '?': () => byId('help').showModal(), f: () => byId('follow').click(), s: () => byId('sensors').click(), Escape: () => this.app.close(),
    };
    const act = keys[pressed] || keys[pressed.toLowerCase()];
    if (!act || (where.getAttribute('role') === 'tab' && pressed.startsWith('Arrow'))) return;
    event.preventDefault();
    act();
  }

  show(frame, fraction) {
    const drive = this.app.drive;
    if (!this.playing) this.time = drive.t[frame] || 0;
    this.bar.max = this.last();
    if (Number(this.bar.value) !== frame) this.bar.value = frame;
    if (!this.playing) this.tell(frame);
    const key = `${frame} ${drive.count}`;
    if (key === this.said) return;
    this.said = key;
    byId('clock').replaceChildren(make('b', {}, clock(drive.t[frame])), ` / ${clock(drive.t[this.last()])}`, make('small', {}, drive.count ? `tick ${frame + 1} of ${drive.count}` : 'no ticks'));
  }

  /// What the bar says to who has the focus on it; not ten times a second.
  tell(frame) {
    const drive = this.app.drive;
    this.bar.setAttribute('aria-valuetext', `tick ${frame + 1} of ${drive.count}, ${clock(drive.t[frame])}, ${drive.strategyName(frame) || 'no strategy'}`);
  }

  /// Which kind of strategy ran when, in the colours of the track, each kind with its own stroke; notes as flags.
  drawBands() {
    const drive = this.app.drive, ratio = window.devicePixelRatio || 1, width = this.bands.clientWidth, height = this.bands.clientHeight;
    if (width < 10) return;
    this.bands.width = Math.round(width * ratio), this.bands.height = Math.round(height * ratio);
    const c = this.bands.getContext('2d'), inner = width - 12, last = Math.max(1, this.last());
    const x = (frame) => 6 + inner * frame / last;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.fillStyle = colour('road'), c.fillRect(6, 12, inner, 10);
    drive.strategy.frames.forEach((frame, i) => {
      const next = drive.strategy.frames[i + 1] ?? drive.count - 1, kind = drive.kindOf(frame);
      if (kind === drive.noKind) return;
      c.strokeStyle = lookColour(kind), c.lineWidth = 10, c.setLineDash(dashes(kind));
      c.beginPath(), c.moveTo(x(frame), 17), c.lineTo(Math.max(x(next), x(frame) + 1), 17), c.stroke();
    });
    c.setLineDash([]), c.fillStyle = colour('ink');
    for (const note of drive.notes) c.beginPath(), c.moveTo(x(note.frame) - 4, 2), c.lineTo(x(note.frame) + 4, 2), c.lineTo(x(note.frame), 10), c.closePath(), c.fill();
  }
}
