// Puts the page together: one drive, what is shown of it, and what is chosen.

/// Finds an element again, or the one that has come in its place: of the same cell, or of the same firing.
function finder(element) {
  const {cell, entry} = element.dataset, box = element.parentElement && element.parentElement.closest('[id]');
  return () => (element.isConnected ? element : box && box.querySelector(cell !== undefined ? `[data-cell="${cell}"]` : `[data-entry="${entry}"]`));
}

class App {
  constructor(data) {
    this.drive = new Drive(data.drive);
    this.drive.append(data.frames);
    this.live = !!data.live;
    this.conditions = new Conditions(this.drive);
    this.frame = 0, this.fraction = 0;
    this.chosen = null;
    document.body.classList.toggle('floorless', !this.drive.picture.landmarks.length), document.body.classList.toggle('legless', !this.drive.legs.length);
    this.floor = new FloorView(byId('floor'), this.drive, this.conditions);
    this.player = new Player(this);
    this.facts = new FactsView(this), this.satellites = new SatellitesView(this);
    this.now = new NowView(this), this.log = new LogView(this), this.why = new WhyView(this), this.history = new HistoryView(this);
    this.views = [this.now, this.facts, this.satellites, this.log, this.history, this.why, this.player];
    this.buttons();
    this.tabs();
    this.outcome();
    fillLegend(this.drive), dark.addEventListener('change', () => { fillLegend(this.drive); this.refresh(); });
    this.player.button();
    if (this.live) new Live(this, data.live);
    const wanted = /^#tick=(\d+)$/.exec(location.hash);
    this.go(wanted ? Number(wanted[1]) - 1 : this.live ? this.drive.count - 1 : 0);
  }

  outcome() {
    const text = this.drive.outcome, place = byId('outcome');
    const good = text.startsWith('arrived');
    place.textContent = text ? `${good ? '✓' : '▲'} ${text}` : '', place.title = text;
    place.className = `outcome ${good ? 'good' : text ? 'bad' : ''}`;
  }

  /// To a frame, as if time stood still there.
  go(frame) {
    const to = Math.min(Math.max(0, frame), Math.max(0, this.drive.count - 1));
    this.player.time = this.drive.t[to] || 0;
    this.show(to, 0);
  }
  /// At a frame and a part of the way to the next.
  show(frame, fraction) {
    const same = frame === this.frame && this.shown;
    this.frame = frame, this.fraction = fraction, this.shown = true;
    this.floor.show(frame, fraction);
    if (same) this.player.show(frame, fraction);
    else for (const view of this.views) view.show(frame, fraction);
  }
  refresh() {
    this.shown = false;
    this.show(this.frame, this.fraction);
  }
  /// To a frame that a button names.
  jump(frame) { this.go(frame), this.speak(); }
  /// A cell or a rule to be explained; `event` is the press that asks for it. The keyboard goes to the explanation.
  choose(what, event) {
    if (what.cell < 0) return this.close();
    const focus = document.activeElement, byKey = !!event && event.detail === 0;
    if (!byId('why-panel').contains(focus)) this.asked = byKey ? finder(focus) : null;
    this.chosen = what;
    this.tab('why');
    this.why.last = 0;               // at once, also while it plays
    this.refresh();
    if (byKey) this.why.title.focus();
    set(byId('spoken'), this.why.inShort());
  }
  /// Nothing is explained any more. The keyboard goes back to where it asked.
  close() {
    const focus = document.activeElement, within = byId('why-panel').contains(focus) || focus === byId('tab-why');
    this.chosen = null;
    if (!byId('why-panel').hidden) this.tab('log');
    this.refresh();
    if (!within) return;
    const asked = this.asked && this.asked();
    (asked && asked.offsetParent ? asked : byId('tab-log')).focus();
  }
  /// More frames have come; who looks at the end goes on looking at it.
  grown(atEnd) {
    this.player.drawBands();
    this.facts.filter(), this.satellites.filter(), this.outcome(), fillLegend(this.drive);
    if (this.history.cells.length !== this.drive.cells.filter((cell) => this.drive.changes(cell)).length) this.history.fill();
    if (atEnd && !this.player.playing) this.go(this.drive.count - 1);
    else this.refresh();
  }
  speak() {
    const drive = this.drive, frame = this.frame;
    const cell = this.chosen && drive.cells[this.chosen.cell], chosen = cell ? `, ${cell.name} ${certainty(cell.steps.at(frame))}` : '';
    if (drive.count) set(byId('spoken'), `tick ${frame + 1}, ${drive.strategyName(frame) || 'no strategy'}, ${drive.legs.length ? `leg ${drive.leg.at(frame) || 'none'}, ` : ''}${drive.status.at(frame)}${chosen}`);
    if (drive.picture.landmarks.length) byId('floor').setAttribute('aria-label', `The labyrinth from above at ${clock(drive.t[frame])}: ${drive.strategyName(frame) || 'no strategy'}, at ${(drive.x[frame] || 0).toFixed(2)} m east, ${(drive.y[frame] || 0).toFixed(2)} m north`);
  }

  buttons() {
    const press = (id, on) => byId(id).setAttribute('aria-pressed', on);
    onPress(byId('fit'), () => { this.floor.whole(); press('fit', true), press('follow', false); });
    onPress(byId('follow'), () => {
      const on = !this.floor.following;
      this.floor.follow(on), press('follow', on), press('fit', !on);
    });
    onPress(byId('sensors'), () => { this.floor.sensing = !this.floor.sensing, press('sensors', this.floor.sensing), this.floor.redraw(); });
    onPress(byId('enlarge'), () => this.floor.nearer(kNearer)), onPress(byId('reduce'), () => this.floor.nearer(1 / kNearer));
    onPress(byId('help-open'), () => byId('help').showModal());
    for (const link of document.querySelectorAll('.skips a')) {
      link.addEventListener('click', (event) => {
        event.preventDefault();      // the address may name a tick
        const to = link.hash === '#tab-log' ? '.tabs [aria-selected="true"]' : link.hash;
        document.querySelector(to).focus();
      });
    }
    for (const id of ['all-facts', 'all-satellites']) byId(id).addEventListener('change', () => this.refresh());
  }
  tabs() {
    const tabs = ['log', 'why', 'live'];
    for (const name of tabs) {
      const tab = byId(`tab-${name}`);
      onPress(tab, () => { this.tab(name); this.refresh(); });
      tab.addEventListener('keydown', (event) => {
        const open = tabs.filter((one) => !byId(`tab-${one}`).hidden), by = {ArrowRight: 1, ArrowLeft: -1}[event.key];
        if (!by) return;
        const next = open[(open.indexOf(name) + by + open.length) % open.length];
        this.tab(next), byId(`tab-${next}`).focus(), this.refresh();
      });
    }
  }
  tab(name) {
    for (const one of ['log', 'why', 'live']) {
      const on = one === name;
      byId(`tab-${one}`).setAttribute('aria-selected', on), byId(`tab-${one}`).tabIndex = on ? 0 : -1;
      byId(`${one}-panel`).hidden = !on;
    }
    this.log.key = this.why.key = '';
  }
}

const app = new App(JSON.parse(byId('recording').textContent));
window.waymark = app;   // for the console, and for tests
