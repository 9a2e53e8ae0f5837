// The labyrinth from above: what never moves is drawn once into a picture of its own, all else at every frame.

const kObstacle = 0, kClosedRoad = 1, kLostMarking = 2, kUnsafeCrossing = 3;
const kAzimuthRoad = 2;
const kOutOfRange = 4;
const kNearer = 1.25, kPushPx = 40;     // a press of a key or a button enlarges and moves by as much
const dark = matchMedia('(prefers-color-scheme: dark)');
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
const lookColour = (kind) => (dark.matches ? kind.dark : kind.light);
const dashes = (kind) => (kind.dash ? kind.dash.split(' ').map(Number) : []);

/// The point in the middle of a line of points.
function halfway(points) {
  const length = (i) => Math.hypot(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y);
  let rest = points.slice(1).reduce((sum, _, i) => sum + length(i), 0) / 2;
  for (let i = 0; i + 1 < points.length; ++i) {
    if (rest <= length(i) && length(i) > 0) {
      const part = rest / length(i);
      return {x: points[i].x + part * (points[i + 1].x - points[i].x), y: points[i].y + part * (points[i + 1].y - points[i].y)};
    }
    rest -= length(i);
  }
  return points[0];
}

class FloorView {
  constructor(canvas, drive, conditions) {
    this.canvas = canvas, this.drive = drive, this.conditions = conditions;
    this.context = canvas.getContext('2d');
    this.floor = document.createElement('canvas');     // what never moves
    this.following = false, this.sensing = true;
    this.zoom = 1, this.shiftX = 0, this.shiftY = 0;   // of the whole, by wheel and by dragging; pixels
    this.stale = true;
    this.frame = 0, this.fraction = 0;
    new ResizeObserver(() => this.redraw()).observe(canvas);
    dark.addEventListener('change', () => this.redraw());
    this.listen();
  }

  redraw() {
    this.stale = true;
    this.show(this.frame, this.fraction);
  }

  listen() {
    let from = null;
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const box = this.canvas.getBoundingClientRect();
      this.enlarge(Math.exp(-event.deltaY * 0.0015), event.clientX - box.left, event.clientY - box.top);
    }, {passive: false});
    this.canvas.addEventListener('pointerdown', (event) => {
      from = {x: event.clientX, y: event.clientY};
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!from) return;
      this.shiftX += event.clientX - from.x, this.shiftY += event.clientY - from.y;
      from = {x: event.clientX, y: event.clientY};
      this.redraw();
    });
    this.canvas.addEventListener('mousedown', (event) => event.preventDefault());   // the mouse leaves the focus, and with it the keys, where they are
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    for (const end of ['pointerup', 'pointercancel']) this.canvas.addEventListener(end, () => { from = null; });
  }
  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const far = kPushPx * (event.shiftKey ? 4 : 1), push = (x, y) => { this.shiftX += x, this.shiftY += y, this.redraw(); };
    const nearer = () => this.nearer(kNearer), farther = () => this.nearer(1 / kNearer);
    const act = {ArrowLeft: () => push(far, 0), ArrowRight: () => push(-far, 0), ArrowUp: () => push(0, far), ArrowDown: () => push(0, -far),
      '+': nearer, '=': nearer, '-': farther, '_': farther, 0: () => byId('fit').click()}[event.key];
    if (!act) return;
    event.preventDefault(), event.stopPropagation();
    act();
  }
  /// About the middle of the picture.
  nearer(factor) {
    const box = this.canvas.getBoundingClientRect();
    this.enlarge(factor, box.width / 2, box.height / 2);
  }
  enlarge(factor, x, y) {
    const zoom = Math.min(20, Math.max(0.5, this.zoom * factor)), real = zoom / this.zoom;
    const box = this.canvas.getBoundingClientRect();
    const cx = this.following ? 0 : x - box.width / 2, cy = this.following ? 0 : y - box.height / 2;
    this.shiftX = cx - (cx - this.shiftX) * real, this.shiftY = cy - (cy - this.shiftY) * real;
    this.zoom = zoom;
    this.redraw();
  }
  whole() {
    this.following = false, this.zoom = 1, this.shiftX = this.shiftY = 0;
    this.redraw();
  }
  follow(on) {
    this.following = on, this.zoom = on ? 3 : 1, this.shiftX = this.shiftY = 0;
    this.redraw();
  }

  /// Metres to pixels of the canvas: px a metre, and where the middle of the picture lies.
  place(pose) {
    const {low, high} = this.drive.picture, ratio = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio), this.canvas.height = Math.round(height * ratio);
      this.stale = true;
    }
    const wide = Math.max(high.x - low.x, 0.5), tall = Math.max(high.y - low.y, 0.5);
    const scale = Math.min((width - 36) / wide, (height - 74) / tall) * this.zoom;
    const middle = this.following && pose ? pose : {x: (low.x + high.x) / 2, y: (low.y + high.y) / 2};
    return {ratio, width, height, scale, x0: width / 2 + this.shiftX - middle.x * scale, y0: height / 2 + 4 + this.shiftY + middle.y * scale};
  }

  /// Between frames a robot moves evenly.
  pose(frame, fraction) {
    const d = this.drive, next = Math.min(frame + 1, d.count - 1);
    if (!d.count || !Number.isFinite(d.x[frame] + d.y[frame] + d.h[frame])) return null;
    const far = !Number.isFinite(d.x[next] + d.h[next]) || Math.hypot(d.x[next] - d.x[frame], d.y[next] - d.y[frame]) > 0.5;
    const part = far ? 0 : fraction;
    let turn = d.h[next] - d.h[frame];
    turn -= 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    return {x: d.x[frame] + part * (d.x[next] - d.x[frame]), y: d.y[frame] + part * (d.y[next] - d.y[frame]), h: d.h[frame] + part * (far ? 0 : turn)};
  }

  show(frame, fraction) {
    this.frame = frame, this.fraction = fraction;
    const pose = this.pose(frame, fraction), at = this.place(pose), c = this.context;
    if (at.width < 2 || at.height < 2) return;
    this.at = at;
    if (this.stale || this.following) this.drawFloor(at);
    this.stale = false;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    c.drawImage(this.floor, 0, 0);
    c.setTransform(at.ratio, 0, 0, at.ratio, 0, 0);
    this.drawLegs(c, frame);
    this.drawThings(c, frame);
    this.drawTrack(c, frame, pose);
    this.drawNames(c);
    this.drawNotes(c, frame);
    if (!pose) return;
    if (this.sensing) this.drawSenses(c, frame, pose);
    this.drawRobot(c, frame, pose);
  }

  sx(x) { return this.at.x0 + x * this.at.scale; }
  sy(y) { return this.at.y0 - y * this.at.scale; }
  line(c, x1, y1, x2, y2) {
    c.beginPath(), c.moveTo(this.sx(x1), this.sy(y1)), c.lineTo(this.sx(x2), this.sy(y2)), c.stroke();
  }
  outline(c, points) {
    c.beginPath();
    points.forEach((p, i) => (i ? c.lineTo(this.sx(p.x), this.sy(p.y)) : c.moveTo(this.sx(p.x), this.sy(p.y))));
  }
  path(c, points) {
    this.outline(c, points);
    c.stroke();
  }
  pen(c, stroke, width, dash = [], alpha = 1) {
    c.strokeStyle = stroke, c.lineWidth = width, c.globalAlpha = alpha;
    c.setLineDash(dash);
  }

  drawFloor(at) {
    this.floor.width = this.canvas.width, this.floor.height = this.canvas.height;
    const c = this.floor.getContext('2d'), p = this.drive.picture;
    c.setTransform(at.ratio, 0, 0, at.ratio, 0, 0);
    for (const hall of p.halls) {
      this.pen(c, colour('road'), Math.max(4, hall.width * at.scale), [], 0.6);
      this.path(c, hall.along);
    }
    c.lineCap = c.lineJoin = 'round';
    for (const road of p.roads) {
      this.pen(c, colour('road'), Math.max(4, road.width * at.scale));
      this.path(c, road.along);
    }
    for (const road of p.roads) {
      if (road.kind !== kAzimuthRoad) continue;        // nothing on the floor tells such a road
      this.pen(c, colour('faint'), 1.2, [1, 6]);
      this.path(c, road.along);
    }
    c.lineCap = 'butt';
    const paint = colour('paint');
    for (const s of p.lines) this.pen(c, paint, Math.min(7, Math.max(1.3, s.w * at.scale)), [], 0.75), this.line(c, s.x1, s.y1, s.x2, s.y2);
    for (const s of p.stops) this.pen(c, paint, Math.min(7, Math.max(1.6, s.w * at.scale))), this.line(c, s.x1, s.y1, s.x2, s.y2);
    c.lineCap = 'round';
    this.pen(c, colour('wall'), 2.4);
    c.fillStyle = colour('wall'), c.globalAlpha = 0.35;
    for (const block of p.blocks) this.outline(c, block), c.fill();
    c.globalAlpha = 1;
    for (const s of p.walls) this.line(c, s.x1, s.y1, s.x2, s.y2);
    c.globalAlpha = 1;
  }

  pointsOf(leg) {
    const road = this.drive.picture.roads[leg.road];
    if (road) return road.along;
    const spot = (name) => this.drive.picture.landmarks.find((one) => one.name === name);
    return [spot(leg.from), spot(leg.to)].filter(Boolean);
  }
  /// The route as a broad band, a detour as a dashed one once it has been taken; the current leg strongest.
  drawLegs(c, frame) {
    const current = this.drive.leg.at(frame), width = Math.max(7, Math.min(16, 0.16 * this.at.scale));
    c.lineCap = 'butt', c.lineJoin = 'round';
    for (const leg of this.drive.legs) {
      const now = leg.name === current;
      if (leg.detour && (leg.used < 0 || leg.used > frame)) continue;
      this.pen(c, colour(leg.detour ? 'orange' : 'blue'), now ? width : width * 0.8, leg.detour ? [6, 4] : [], now ? 0.55 : 0.2);
      this.path(c, this.pointsOf(leg));
    }
    c.globalAlpha = 1, c.setLineDash([]);
  }

  drawThings(c, frame) {
    const orange = colour('orange'), ink = colour('ink'), card = colour('card');
    for (const s of this.drive.stays) {
      if (frame < s.first || frame >= s.last || !Number.isFinite(s.x1 + s.y1 + s.x2 + s.y2)) continue;
      const x = this.sx((s.x1 + s.x2) / 2), y = this.sy((s.y1 + s.y2) / 2);
      if (s.kind === kObstacle) this.drawObstacle(c, s, ink, card);
      else if (s.kind === kClosedRoad) {
        const along = this.roadOf(s), middle = halfway(along);
        this.pen(c, orange, 5, [3, 5]), this.path(c, along);
        for (const [ink2, width] of [[card, 7], [orange, 3.4]]) this.pen(c, ink2, width), this.cross(c, this.sx(middle.x), this.sy(middle.y), 8);
      } else if (s.kind === kLostMarking) {
        this.pen(c, colour('road'), 7), this.line(c, s.x1, s.y1, s.x2, s.y2);
        this.pen(c, orange, 2, [1, 6]), this.line(c, s.x1, s.y1, s.x2, s.y2);
      } else if (s.kind === kUnsafeCrossing) {
        this.pen(c, orange, 2), c.fillStyle = card;
        c.beginPath(), c.moveTo(x, y - 24), c.lineTo(x + 9, y - 8), c.lineTo(x - 9, y - 8), c.closePath(), c.fill(), c.stroke();
        c.fillStyle = orange, c.font = '700 11px system-ui, sans-serif', c.textAlign = 'center', c.fillText('!', x, y - 10);
      }
    }
    c.setLineDash([]);
  }
  /// The road that a thing is about, with its bends; else the straight line.
  roadOf(thing) {
    const road = this.drive.picture.roads.find((one) => one.name === thing.name);
    return road && road.along.length > 1 ? road.along : [{x: thing.x1, y: thing.y1}, {x: thing.x2, y: thing.y2}];
  }
  cross(c, x, y, r) {
    c.beginPath(), c.moveTo(x - r, y - r), c.lineTo(x + r, y + r), c.moveTo(x - r, y + r), c.lineTo(x + r, y - r), c.stroke();
  }
  drawObstacle(c, s, ink, card) {
    const left = this.sx(Math.min(s.x1, s.x2)), top = this.sy(Math.max(s.y1, s.y2));
    const width = Math.max(6, Math.abs(s.x2 - s.x1) * this.at.scale), height = Math.max(6, Math.abs(s.y2 - s.y1) * this.at.scale);
    c.save();
    this.oval(c, left, top, width, height), c.fillStyle = card, c.fill(), c.clip();
    this.pen(c, ink, 1.6);
    for (let k = -height; k < width; k += 5) c.beginPath(), c.moveTo(left + k, top + height), c.lineTo(left + k + height, top), c.stroke();
    c.restore();
    this.pen(c, ink, 1.4), this.oval(c, left, top, width, height), c.stroke();
  }
  oval(c, left, top, width, height) {
    c.beginPath(), c.ellipse(left + width / 2, top + height / 2, width / 2, height / 2, 0, 0, 7);
  }

  drawTrack(c, frame, pose) {
    const d = this.drive;
    c.lineCap = 'butt', c.lineJoin = 'round';
    let begin = 0;
    while (begin <= frame && begin < d.count) {
      const kind = d.kindOf(begin);
      let end = begin;
      while (end < frame && d.kindOf(end + 1) === kind) end = this.nextKind(end, frame);
      c.beginPath();
      let x = NaN, y = NaN;
      for (let i = begin; i <= Math.min(end + 1, frame); ++i) {
        const px = this.sx(d.x[i]), py = this.sy(d.y[i]);
        if (!Number.isFinite(px + py)) { x = NaN; continue; }
        if (i !== end + 1 && i !== frame && Math.abs(px - x) + Math.abs(py - y) < 1.5) continue;
        Number.isFinite(x) ? c.lineTo(px, py) : c.moveTo(px, py);
        x = px, y = py;
      }
      if (end >= frame && pose && Number.isFinite(x)) c.lineTo(this.sx(pose.x), this.sy(pose.y));
      // On a ground of its own: a dotted track on a painted line would not be seen.
      this.pen(c, colour('card'), 4.6, [], 0.9), c.stroke();
      this.pen(c, lookColour(kind), 2.8, dashes(kind)), c.stroke();
      begin = end + 1;
    }
    c.setLineDash([]), c.globalAlpha = 1;
  }
  /// The last frame, at most `frame`, up to which the strategy is that of `from + 1`.
  nextKind(from, frame) {
    const next = this.drive.strategy.next(from + 1);
    return Math.min(frame, next < 0 ? frame : next - 1);
  }

  drawNames(c) {
    const ink = colour('ink'), card = colour('card');
    c.font = '600 11.5px system-ui, "DejaVu Sans", sans-serif', c.textAlign = 'left', c.lineJoin = 'round';
    const waits = new Set();
    for (const cell of this.drive.cells) {
      if (cell.kind === kFact && cell.satellites.some((id) => this.drive.value(id, this.frame) >= this.drive.firing)) waits.add(cell.name);
    }
    for (const mark of this.drive.picture.landmarks) {
      const x = this.sx(mark.x), y = this.sy(mark.y), awaited = waits.has(mark.name);
      this.pen(c, awaited ? colour('blue') : ink, awaited ? 2.4 : 1.5);
      c.fillStyle = card;
      c.beginPath(), c.rect(x - 4.5, y - 4.5, 9, 9), c.fill(), c.stroke();
      if (awaited) c.beginPath(), c.arc(x, y, 10, 0, 7), c.stroke();
      const left = x > this.at.width ? x + 9 : Math.min(x + 9, this.at.width - c.measureText(mark.name).width - 3);
      this.pen(c, card, 3.5, [], 0.85), c.strokeText(mark.name, left, y - 9);
      c.globalAlpha = 1, c.fillStyle = awaited ? colour('blue') : ink, c.fillText(mark.name, left, y - 9);
    }
  }

  /// Numbers where the robot was when something was noted; those of one tick stand together.
  drawNotes(c, frame) {
    const ink = colour('ink'), card = colour('card'), notes = this.drive.notes;
    c.font = '700 10px system-ui, "DejaVu Sans", sans-serif', c.textAlign = 'center';
    for (let i = 0; i < notes.length && notes[i].frame <= frame;) {
      let last = i;
      while (last + 1 < notes.length && notes[last + 1].frame === notes[i].frame) ++last;
      const x = this.sx(this.drive.x[notes[i].frame]) - 15, y = this.sy(this.drive.y[notes[i].frame]) + 15;
      const text = last > i ? `${i + 1}–${last + 1}` : String(i + 1), half = Math.max(8, c.measureText(text).width / 2 + 4);
      i = last + 1;
      if (!Number.isFinite(x + y)) continue;
      c.fillStyle = ink, c.beginPath(), c.roundRect(x - half, y - 8, 2 * half, 16, 8), c.fill();
      c.fillStyle = card, c.fillText(text, x, y + 3.5);
    }
  }

  radius() { return Math.max(8, this.drive.picture.radius * this.at.scale); }
  drawSenses(c, frame, pose) {
    const s = this.drive.senses, x = this.sx(pose.x), y = this.sy(pose.y), r = this.radius();
    for (let i = 0; i < 8; ++i) {
      const range = s.range[i][frame];
      if (!Number.isFinite(range)) continue;
      const angle = pose.h + i * Math.PI / 4, free = range >= kOutOfRange - 0.01, far = Math.max(r, free ? 3.5 * r : range * this.at.scale);
      const ex = x + Math.cos(angle) * far, ey = y - Math.sin(angle) * far;
      this.pen(c, colour('soft'), 1, [2, 4], free ? 0.25 : 0.8);
      c.beginPath(), c.moveTo(x, y), c.lineTo(ex, ey), c.stroke();
      if (!free) this.pen(c, colour('orange'), 2.4), c.beginPath(), c.arc(ex, ey, 2.5, 0, 7), c.stroke();
    }
    c.globalAlpha = 1, c.setLineDash([]);
    const told = this.drive.byWheels(frame);
    if (told && Math.hypot(told.x - pose.x, told.y - pose.y) * this.at.scale > 3) {
      this.pen(c, colour('soft'), 1.2, [3, 3]), c.beginPath(), c.arc(this.sx(told.x), this.sy(told.y), r, 0, 7), c.stroke(), c.setLineDash([]);
    }
  }

  drawRobot(c, frame, pose) {
    const s = this.drive.senses, r = this.radius(), ink = colour('ink'), card = colour('card');
    c.save();
    c.translate(this.sx(pose.x), this.sy(pose.y)), c.rotate(-pose.h);
    if (s.touched[frame]) this.pen(c, colour('orange'), 4), c.beginPath(), c.arc(0, 0, r + 4, 0, 7), c.stroke();
    c.fillStyle = lookColour(this.drive.kindOf(frame)), this.pen(c, card, 2);
    c.beginPath(), c.arc(0, 0, r, 0, 7), c.fill(), c.stroke();
    this.pen(c, ink, 1.2), c.beginPath(), c.arc(0, 0, r + 1, 0, 7), c.stroke();
    c.fillStyle = card, c.beginPath(), c.moveTo(r * 0.72, 0), c.lineTo(-r * 0.42, r * 0.5), c.lineTo(-r * 0.42, -r * 0.5), c.closePath(), c.fill();
    for (let i = 0; this.sensing && i < 5; ++i) {     // the line sensors across the front, the first at the left
      const value = s.line[i][frame];
      if (!Number.isFinite(value)) continue;
      const size = Math.max(2, r * 0.2);
      c.fillStyle = card, this.pen(c, ink, 1);
      c.beginPath(), c.arc(r + size + 2, (i - 2) * size * 2.3, size, 0, 7), c.fill();
      c.globalAlpha = Math.min(1, Math.max(0, value)), c.fillStyle = ink, c.fill();
      c.globalAlpha = 1, c.stroke();
    }
    c.restore();
  }
}
