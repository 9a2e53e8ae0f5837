// A drive that is still going on: further frames come from the server, commands go to it.

const kPollMs = 250;

class Live {
  constructor(app, path) {
    this.app = app, this.path = path;
    this.closed = new Set();
    byId('tab-live').hidden = false, byId('live').hidden = false;
    this.fill();
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
    const roads = drive.picture.roads.map((road) => {
      const button = onPress(make('button', {'aria-pressed': 'false', 'data-road': road.name}, 'close'), () => this.close(road.name, button));
      return make('li', {}, `${road.from} – ${road.to} `, make('span.is', {}, road.name), button);
    });
    panel.replaceChildren(make('div.roads', {}, make('p', {}, pause), make('h4', {}, 'Commands'), make('div.why', {}, make('div.jumps', {}, ...commands)), make('h4', {}, 'Roads'), make('ul', {}, ...roads)));
  }
  close(road, button) {
    const closing = !this.closed.has(road);
    this.send(closing ? 'close' : 'open', road).then((ok) => {
      if (!ok) return;
      closing ? this.closed.add(road) : this.closed.delete(road);
      set(button, closing ? '✕ closed: open it' : 'close'), button.setAttribute('aria-pressed', closing);
    });
  }

  async send(what, name) {
    try {
      const answer = await fetch(`${this.path}/command`, {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify({what, name})});
      return answer.ok;
    } catch {
      return false;
    }
  }

  async poll() {
    const drive = this.app.drive;
    try {
      const answer = await fetch(`${this.path}/frames?from=${drive.count}`, {cache: 'no-store'});
      const chunk = await answer.json(), atEnd = this.app.frame >= drive.count - 1;
      set(byId('live'), chunk.over ? 'over' : '● live');
      if (chunk.frames.count && drive.append(chunk.frames)) this.app.grown(atEnd);
      if (chunk.over) return void (this.app.live = false);
    } catch {
      set(byId('live'), '○ the simulation does not answer');
    }
    setTimeout(() => this.poll(), kPollMs);
  }
}
