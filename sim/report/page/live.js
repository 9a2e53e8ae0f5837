// A drive that is still going on: further frames come from the server, commands go to it.

const kPollMs = 250;

class Live {
  constructor(app, path) {
    this.app = app, this.path = path;
    this.sliders = new Map();
    byId('tab-live').hidden = false, byId('live').hidden = false;
    this.fill();
    this.follow();
    this.poll();
  }

  fill() {
    const drive = this.app.drive, panel = byId('live-panel');
    const pause = onPress(make('button', {}, 'Pause the simulation'), () => {
      const halt = pause.getAttribute('aria-pressed') !== 'true';
      this.send(halt ? 'pause' : 'resume', '').then((ok) => ok && pause.setAttribute('aria-pressed', halt));
    });
    pause.setAttribute('aria-pressed', 'false');
    const commands = drive.cells.filter((cell) => cell.command).map((cell) => onPress(make('button', {}, cell.name), () => this.send('press', cell.name)));
    const roads = drive.picture.roads.map((road) => make('li', {}, `${road.from} – ${road.to} `, make('span.is', {}, road.name), this.slider(road)));
    panel.replaceChildren(make('div.roads', {}, make('p', {}, pause), make('h4', {}, 'Commands'), make('div.why', {}, make('div.jumps', {}, ...commands)), make('h4', {}, 'Roads'), make('ul', {}, ...roads)));
  }
  /// Two places: at the left the road is open, at the right it is closed. Arrow keys, Home and End move it.
  slider(road) {
    const slider = make('input', {type: 'range', min: 0, max: 1, step: 1, value: 0, 'data-road': road.name, 'aria-label': `Road ${road.name}, ${road.from} – ${road.to}`});
    const state = make('span.state', {'aria-hidden': 'true'});
    slider.addEventListener('change', () => {
      const closing = slider.value === '1';
      this.send(closing ? 'close' : 'open', road.name).then((ok) => this.show(road.name, ok === closing));   // refused: back to where it was
    });
    this.sliders.set(road.name, {slider, state, closed: false});
    this.show(road.name, false);
    return make('label.switch', {}, make('span', {'aria-hidden': 'true'}, 'open'), slider, state);
  }
  show(name, closed) {
    const {slider, state} = this.sliders.get(name);
    slider.value = closed ? 1 : 0;
    slider.setAttribute('aria-valuetext', closed ? 'closed' : 'open');
    set(state, closed ? '✕ closed' : 'closed');
  }
  /// What the scenario, or another page, closes and opens moves the sliders as well.
  follow() {
    const drive = this.app.drive, now = drive.count - 1;
    const closed = new Set(drive.stays.filter((s) => s.kind === kClosedRoad && s.first <= now && now < s.last).map((s) => s.name));
    for (const [name, one] of this.sliders) {
      if (closed.has(name) === one.closed) continue;
      one.closed = closed.has(name);
      this.show(name, one.closed);
    }
  }

  async send(what, name) {
    try {
      const answer = await fetch(`${this.path}/command`, {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify({what, name})});
      return answer.ok;
    } catch {
      return false;
    }
  }

  tell(state, spoken) {
    if (byId('live').textContent === state) return;
    set(byId('live'), state);
    if (spoken) set(byId('spoken'), spoken);
  }
  /// What would act on the drive acts no more.
  end() {
    const panel = byId('live-panel'), within = panel.contains(document.activeElement);
    this.app.live = false;
    for (const one of panel.querySelectorAll('button, input')) one.disabled = true;
    panel.prepend(make('p.over', {}, 'The drive is over: nothing acts on it any more.'));
    if (within) panel.focus();         // a control that is disabled loses the focus
  }

  async poll() {
    const drive = this.app.drive;
    try {
      const answer = await fetch(`${this.path}/frames?from=${drive.count}`, {cache: 'no-store'});
      const chunk = await answer.json(), atEnd = this.app.frame >= drive.count - 1;
      // How it ended may come when its last frames have come already.
      const news = chunk.frames.count || chunk.over || chunk.frames.outcome !== drive.outcome;
      if (news && drive.append(chunk.frames)) this.app.grown(atEnd), this.follow();
      this.tell(chunk.over ? 'over' : '● live', chunk.over ? `the drive is over: ${drive.outcome}` : '');
      if (chunk.over) return this.end();
    } catch {
      this.tell('○ the simulation does not answer', 'the simulation does not answer');
    }
    setTimeout(() => this.poll(), kPollMs);
  }
}
