// The rules as they fired, one row each; only the rows in sight are elements of the page.

const kRowPx = 24;

class LogView {
  constructor(app) {
    this.app = app;
    this.box = byId('log'), this.rows = byId('log-rows');
    this.current = -1;
    this.roving = new Roving(this.rows, '.row', (key) => {
      if (key === 'Home' || key === 'End') this.box.scrollTop = key === 'Home' ? 0 : this.box.scrollHeight;
      this.draw();
    });
    this.box.addEventListener('scroll', () => this.draw());
    new ResizeObserver(() => this.show(this.app.frame)).observe(this.box);
  }
  /// The last firing that began by now.
  find(frame) {
    let low = 0, high = this.app.drive.log.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.app.drive.log[middle].first <= frame) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }
  show(frame) {
    const current = this.find(frame), height = this.box.clientHeight;
    this.rows.style.height = `${this.app.drive.log.length * kRowPx}px`;
    if (current !== this.current && height > 0) {   // behind another tab it has no height, and cannot be scrolled
      this.current = current;
      const top = current * kRowPx;
      if (top < this.box.scrollTop || top > this.box.scrollTop + height - 3 * kRowPx) this.box.scrollTop = Math.max(0, top - height / 2);
    }
    this.draw();
  }
  draw() {
    const drive = this.app.drive, frame = this.app.frame, log = drive.log;
    const first = Math.max(0, Math.floor(this.box.scrollTop / kRowPx) - 3), last = Math.min(log.length, Math.ceil((this.box.scrollTop + this.box.clientHeight) / kRowPx) + 3);
    const key = `${first} ${last} ${frame} ${log.length}`;
    if (this.key === key) return;
    this.key = key;
    const focus = this.rows.contains(document.activeElement) ? document.activeElement.dataset.entry : undefined;
    const rows = [];
    for (let i = first; i < last; ++i) rows.push(this.row(log[i], i, frame));
    this.rows.replaceChildren(...rows);
    if (!log.length) this.rows.replaceChildren(make('li.empty', {}, 'No rule has fired.'));
    const again = focus !== undefined && this.rows.querySelector(`[data-entry="${focus}"]`);
    if (focus !== undefined) (again || this.box).focus({preventScroll: true});   // its row may be far away by now
    this.roving.settle(again || this.rows.querySelector(`[data-entry="${this.current}"]`));
  }
  row(entry, i, frame) {
    const drive = this.app.drive, rule = drive.rules[entry.rule], now = entry.first <= frame && frame < entry.last;
    const button = onPress(make(`button.row${entry.first > frame ? '.future' : now ? '.current' : ''}`, {title: `${rule.name}\n${rule.at}`},
      make('span.when', {}, clock(drive.t[entry.first])), make('span.name', {}, rule.name), make('span.level', {}, drive.levels[rule.level] || '')),
    (event) => { this.app.go(entry.first); this.app.choose({rule: entry.rule}, event); });
    button.dataset.entry = i;
    button.style.top = `${i * kRowPx}px`;
    return make('li', {}, button);
  }
}
