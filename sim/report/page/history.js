// Cells by ticks, as in Table 1 of the paper: only cells that change. Columns are the ticks at which something changed, or
// all ticks. Drawn as far as it is in sight.

const kLeastPx = 16, kRoomyPx = 24, kHeadPx = 18;   // the height of a row: as small as it may be, and as large as a finger needs it
const roomy = matchMedia('(max-width: 900px), (pointer: coarse)');

class HistoryView {
  constructor(app) {
    this.app = app;
    this.canvas = byId('cells'), this.box = byId('history');
    this.byTurn = true;
    this.cells = [];
    this.left = 0;                     // the first column in sight
    this.rowPx = kLeastPx;
    this.roving = new Roving(byId('history-names'), 'button');
    for (const [id, turn] of [['by-turn', true], ['by-tick', false]]) onPress(byId(id), () => this.columns(turn));
    byId('width').addEventListener('input', () => this.show(this.app.frame));
    byId('history-facts').addEventListener('change', () => this.fill());
    onPress(this.canvas, (event) => this.click(event));
    this.box.addEventListener('scroll', () => this.show(this.app.frame));
    new ResizeObserver(() => this.show(this.app.frame)).observe(this.box);
    dark.addEventListener('change', () => this.show(this.app.frame));
    this.fill();
  }
  columns(turn) {
    this.byTurn = turn;
    byId('by-turn').setAttribute('aria-pressed', turn), byId('by-tick').setAttribute('aria-pressed', !turn);
    byId('width').value = turn ? 22 : 4;
    this.show(this.app.frame);
  }
  fill() {
    const drive = this.app.drive, facts = byId('history-facts').checked;
    const of = (kind) => (kind === kFact ? factsInOrder(drive) : drive.cells.filter((cell) => cell.kind === kind)).filter((cell) => drive.changes(cell));
    const groups = [of(kStrategy), of(kSatellite), facts ? of(kFact) : []];
    this.cells = groups.flat();
    const names = byId('history-names'), focus = names.contains(document.activeElement) && document.activeElement.dataset.cell;
    names.replaceChildren(...groups.flatMap((group) => group.map((cell, i) => {
      const button = onPress(make(i ? 'button' : 'button.first', {title: cell.name}, cell.name), (event) => this.app.choose({cell: cell.id}, event));
      button.dataset.cell = cell.id;
      return button;
    })));
    const again = focus && names.querySelector(`[data-cell="${focus}"]`);
    if (again) again.focus({preventScroll: true});
    this.roving.settle(again);
    this.show(this.app.frame);
  }

  count() { return this.byTurn ? this.app.drive.turns.length : this.app.drive.count; }
  frameOf(column) { return this.byTurn ? this.app.drive.turns[column] : column; }
  columnOf(frame) { return this.byTurn ? Math.max(0, countUpTo(this.app.drive.turns, frame) - 1) : frame; }

  click(event) {
    const box = this.canvas.getBoundingClientRect(), width = Number(byId('width').value);
    const column = this.left + Math.floor((event.clientX - box.left) / width);
    const row = Math.floor((event.clientY - box.top - kHeadPx + this.scroll()) / this.rowPx);
    if (column < this.count()) this.app.go(this.frameOf(column));
    if (event.clientY - box.top > kHeadPx && this.cells[row]) this.app.choose({cell: this.cells[row].id}, event);
  }
  scroll() { return this.box.scrollTop; }
  /// Rows are as high as lets all of them be in sight.
  fit() {
    const fits = Math.floor((this.box.clientHeight - kHeadPx) / Math.max(1, this.cells.length));
    this.rowPx = roomy.matches ? kRoomyPx : Math.min(kRoomyPx, Math.max(kLeastPx, fits));
    this.box.style.setProperty('--cell-high', `${this.rowPx}px`);
  }

  show(frame) {
    const ratio = window.devicePixelRatio || 1, width = this.canvas.parentElement.clientWidth, height = this.box.clientHeight;
    if (width < 10 || height < 10) return;
    this.fit();
    this.canvas.style.height = `${height}px`;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio), this.canvas.height = Math.round(height * ratio);
    }
    const c = this.canvas.getContext('2d'), step = Number(byId('width').value), fits = Math.ceil(width / step);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    const now = this.columnOf(frame);
    if (now < this.left + 2 || now > this.left + fits - 4) this.left = now - Math.floor(fits * 0.6);
    this.left = Math.max(0, Math.min(this.left, this.count() - Math.floor(width / step)));
    const paint = {high: colour('high'), zero: colour('zero'), low: colour('low'), card: colour('card'), ink: colour('ink'), soft: colour('faint'), line: colour('line')};
    const last = Math.min(this.count(), this.left + fits);
    this.cells.forEach((cell, row) => {
      const y = kHeadPx + row * this.rowPx - this.scroll();
      if (y > height || y < kHeadPx - this.rowPx) return;
      for (let column = this.left; column < last; ++column) this.cell(c, paint, cell, this.frameOf(column), (column - this.left) * step, y, step);
    });
    this.head(c, paint, step, width, last);
    c.strokeStyle = paint.ink, c.lineWidth = 2;
    c.strokeRect((now - this.left) * step + 0.5, 1, Math.max(step - 1, 2), height - 2);
    this.canvas.setAttribute('aria-label', `Cells by ticks: ${this.cells.length} cells, ${this.count()} columns, the cursor at tick ${frame + 1}`);
  }

  cell(c, paint, cell, frame, x, y, step) {
    const value = cell.steps.at(frame), gap = step > 5 ? 1 : 0, wide = step - gap, tall = this.rowPx - 1, base = y + tall / 2 + 4;
    c.fillStyle = paint.low, c.fillRect(x, y, wide, tall);
    if (!Number.isFinite(value)) { c.fillStyle = paint.soft; if (step >= 9) c.fillText('?', x + wide / 2, base); return; }
    if (value <= -1) return;
    // Shaded by what is certain, and as high as it is: told apart without colours.
    const share = value >= 1 ? 1 : Math.max(0.12, (value + 1) / 2);
    c.fillStyle = value >= this.app.drive.firing ? paint.high : paint.zero;
    c.fillRect(x, y + tall * (1 - share), wide, tall * share);
    if (step < 18) return;
    c.font = '10px system-ui, sans-serif', c.textAlign = 'center';
    c.fillStyle = share > 0.62 && value >= this.app.drive.firing ? paint.card : paint.ink;
    c.fillText(value === 1 ? '1' : value.toFixed(1).replace('0.', '.').replace('-', '−').replace('.0', value === 0 ? '0' : '.0'), x + wide / 2, base);
  }

  head(c, paint, step, width, last) {
    c.fillStyle = paint.card, c.fillRect(0, 0, width, kHeadPx - 1);
    c.font = '10px system-ui, sans-serif', c.textAlign = 'left', c.fillStyle = paint.soft;
    let free = 0;
    for (let column = this.left; column < last; ++column) {
      const x = (column - this.left) * step, round = this.byTurn || column % (step > 12 ? 5 : 50) === 0;
      if (x < free || !round) continue;
      const text = this.byTurn ? String(this.frameOf(column) + 1) : clock(this.app.drive.t[column]);
      c.fillText(text, x + 2, 12);
      free = x + c.measureText(text).width + 7;
    }
  }
}
