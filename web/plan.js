// The map from above, on a canvas.
import { areaOf, distanceToPath, distanceToPlace, isInside } from './geometry.js';
import { Gestures } from './gestures.js';
import { LOOPS, loopAt, paintLoops } from './loops.js';
import { givenName } from './names.js';

const LEAST_SCALE = 2, MOST_SCALE = 2000; // pixels per metre
const TOUCH = 22; // pixels that a finger misses by

/** Draws a map and says what of it is touched. `onTouch` is given {kind, item} or null, and the point in the map. */
export class Plan {
  constructor(canvas, onTouch) {
    this.canvas = canvas;
    this.onTouch = onTouch;
    this.map = null;
    this.grid = null;
    this.trajectory = [];
    this.path = null;
    this.chosen = null;
    this.hidden = new Set([LOOPS]);
    this.scale = 50;
    this.middle = [0, 0];
    new Gestures(this);
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.recolour());
  }

  /** Takes a map, the image of its grid (or null), and the trajectory as a list of points. */
  show(map, gridImage, trajectory) {
    const isFirst = this.map === null;
    this.map = map;
    this.gridImage = gridImage;
    this.trajectory = trajectory;
    this.recolour();
    if (isFirst) this.showAll();
  }

  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  }

  // The grid has three colours, which become those of the page.
  recolour() {
    this.grid = null;
    if (this.gridImage) {
      const grid = document.createElement('canvas');
      grid.width = this.gridImage.width;
      grid.height = this.gridImage.height;
      const context = grid.getContext('2d');
      context.drawImage(this.gridImage, 0, 0);
      const pixels = context.getImageData(0, 0, grid.width, grid.height);
      const colours = ['wall', 'unknown', 'free'].map((name) => rgbOf(this.colour(name)));
      for (let i = 0; i < pixels.data.length; i += 4) {
        const [r, g, b] = colours[pixels.data[i] < 64 ? 0 : pixels.data[i] < 192 ? 1 : 2];
        pixels.data[i] = r;
        pixels.data[i + 1] = g;
        pixels.data[i + 2] = b;
      }
      context.putImageData(pixels, 0, 0);
      this.grid = grid;
    }
    this.draw();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1, box = this.canvas.getBoundingClientRect();
    this.canvas.width = Math.max(1, Math.round(box.width * ratio));
    this.canvas.height = Math.max(1, Math.round(box.height * ratio));
    this.ratio = ratio;
    if (this.isWhole) this.showAll();
    this.draw();
  }

  /** Corners of all that the map has: [least x, least y, most x, most y]. */
  bounds() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const add = ([x, y]) => {
      box[0] = Math.min(box[0], x);
      box[1] = Math.min(box[1], y);
      box[2] = Math.max(box[2], x);
      box[3] = Math.max(box[3], y);
    };
    for (const room of this.map.rooms) room.outline_m.forEach(add);
    for (const place of this.map.places) {
      add(place.position_m);
      place.extent.outlines.flat().forEach(add);
      place.extent.lines.flat().forEach(add);
    }
    this.trajectory.forEach(add);
    return box[0] <= box[2] ? box : [-5, -5, 5, 5];
  }

  showAll() {
    if (!this.map || !this.ratio) return;
    const [x0, y0, x1, y1] = this.bounds();
    const width = this.canvas.width / this.ratio, height = this.canvas.height / this.ratio;
    this.middle = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.setScale(Math.min(width / (x1 - x0 + 1), height / (y1 - y0 + 1)));
    this.isWhole = true;
    this.draw();
  }

  setScale(scale) {
    this.scale = Math.min(MOST_SCALE, Math.max(LEAST_SCALE, scale));
  }

  /** Moves the view so that a point is in its middle, near enough to see a thing. */
  lookAt(point) {
    this.middle = [point[0], point[1]];
    this.setScale(Math.max(this.scale, 40));
    this.isWhole = false;
    this.draw();
  }

  zoom(factor, at = null) {
    const before = at && this.toMap(at);
    this.setScale(this.scale * factor);
    if (before) {
      const after = this.toMap(at);
      this.middle = [this.middle[0] + before[0] - after[0], this.middle[1] + before[1] - after[1]];
    }
    this.isWhole = false;
    this.draw();
  }

  /** A point of the canvas [CSS pixels] in the map [m]. */
  toMap([x, y]) {
    const width = this.canvas.width / this.ratio, height = this.canvas.height / this.ratio;
    return [this.middle[0] + (x - width / 2) / this.scale, this.middle[1] - (y - height / 2) / this.scale];
  }

  /** Moves the view by a way in the map [m]. */
  move([x, y]) {
    this.middle = [this.middle[0] + x, this.middle[1] + y];
    this.isWhole = false;
    this.draw();
  }

  touch(pixel) {
    if (!this.map) return;
    const point = this.toMap(pixel);
    this.onTouch(this.itemAt(point, TOUCH / this.scale), point);
  }

  /** What is at a point: the thing within `reach` [m] that is meant most likely, a door, or the room. */
  itemAt(point, reach) {
    const loop = this.hidden.has(LOOPS) ? null : loopAt(this, point, reach / 3);
    if (loop) return loop;
    let best = null, least = Infinity;
    for (const place of this.map.places) {
      if (this.isHidden(place) || this.map.labels[place.label].covers_the_plan) continue;
      const distance = distanceToPlace(point, place);
      if (distance > reach) continue;
      const rank = rankOf(distance / reach, place.extent.outlines);
      if (rank < least) [best, least] = [{ kind: 'place', item: place }, rank];
    }
    if (best) return best;
    const door = this.map.doors.find((each) => distanceToPath(point, [each.from_m, each.to_m], false) < reach);
    if (door) return { kind: 'door', item: door };
    const room = this.map.rooms.find(
      (each) => isInside(point, each.outline_m) && !each.holes_m.some((hole) => isInside(point, hole)));
    return room ? { kind: 'room', item: room } : null;
  }

  isHidden(place) {
    return this.hidden.has('label ' + place.label);
  }

  choose(chosen) {
    this.chosen = chosen;
    this.draw();
  }

  draw() {
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      if (this.map && this.ratio) this.paint(this.canvas.getContext('2d'));
    });
  }

  paint(context) {
    const width = this.canvas.width / this.ratio, height = this.canvas.height / this.ratio;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = this.colour('unknown');
    context.fillRect(0, 0, width, height);
    // From here on in metres, y up.
    context.setTransform(this.ratio * this.scale, 0, 0, -this.ratio * this.scale,
      this.ratio * (width / 2 - this.middle[0] * this.scale), this.ratio * (height / 2 + this.middle[1] * this.scale));
    context.lineJoin = context.lineCap = 'round';
    if (!this.hidden.has('grid')) this.paintGrid(context);
    if (!this.hidden.has('rooms')) for (const room of this.map.rooms) this.paintRoom(context, room);
    const below = this.map.places.filter((place) => this.map.labels[place.label].covers_the_plan);
    const above = this.map.places.filter((place) => !this.map.labels[place.label].covers_the_plan);
    for (const place of [...below, ...above]) if (!this.isHidden(place)) this.paintPlace(context, place);
    if (!this.hidden.has('doors')) for (const door of this.map.doors) this.paintDoor(context, door);
    if (!this.hidden.has('trajectory')) this.paintPath(context, this.trajectory, this.colour('robot'), 1.5, 0.7);
    if (!this.hidden.has(LOOPS)) paintLoops(this, context);
    if (this.path) this.paintPath(context, this.path, this.colour('chosen'), 4, 1);
    if (this.map.last_pose && !this.hidden.has('robot')) this.paintRobot(context, this.map.last_pose);
    this.paintChosen(context);
    this.paintNames(context, width, height);
    this.paintScale(context, width, height);
  }

  paintGrid(context) {
    const place = this.map.grid;
    if (!this.grid || !place) return;
    context.save();
    context.imageSmoothingEnabled = this.scale * place.cell_m < 1;
    context.translate(place.min_x_m, place.min_y_m + place.rows * place.cell_m);
    context.scale(place.cell_m, -place.cell_m);
    context.drawImage(this.grid, 0, 0);
    context.restore();
  }

  trace(context, walk, closed) {
    walk.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    if (closed) context.closePath();
  }

  paintRoom(context, room) {
    const number = Number(room.id.replace(/\D/g, '')) || 0;
    context.beginPath();
    this.trace(context, room.outline_m, true);
    for (const hole of room.holes_m) this.trace(context, hole, true);
    // Hues of neighbouring numbers are far apart.
    context.fillStyle = `hsl(${(number * 137.5) % 360} 60% 55% / 0.16)`;
    context.fill('evenodd');
  }

  paintPlace(context, place) {
    const { colour, covers_the_plan: covers } = this.map.labels[place.label];
    const { outlines, holes, lines, points } = place.extent;
    context.strokeStyle = context.fillStyle = colour;
    context.setLineDash(place.state === 'moved' ? [4 / this.scale, 4 / this.scale] : []);
    context.globalAlpha = covers ? 0.05 : 0.25;
    context.beginPath();
    for (const outline of outlines) this.trace(context, outline, true);
    for (const hole of holes) this.trace(context, hole, true);
    context.fill('evenodd');
    context.globalAlpha = covers ? 0.3 : 0.9;
    context.lineWidth = (covers ? 1 : 2.5) / this.scale;
    context.beginPath();
    for (const outline of outlines) this.trace(context, outline, true);
    for (const line of lines) this.trace(context, line, false);
    context.stroke();
    for (const [x, y] of points) {
      context.beginPath();
      context.arc(x, y, 5 / this.scale, 0, 2 * Math.PI);
      context.fill();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
  }

  paintDoor(context, door) {
    this.paintPath(context, [door.from_m, door.to_m], this.colour('door'), 4, 0.9);
  }

  paintPath(context, walk, colour, pixels, alpha) {
    if (walk.length < 2) return;
    context.globalAlpha = alpha;
    context.strokeStyle = colour;
    context.lineWidth = pixels / this.scale;
    context.beginPath();
    this.trace(context, walk, false);
    context.stroke();
    context.globalAlpha = 1;
  }

  paintRobot(context, pose) {
    context.save();
    context.translate(pose.x_m, pose.y_m);
    context.rotate(pose.yaw_rad);
    context.scale(1 / this.scale, 1 / this.scale);
    context.fillStyle = this.colour('robot');
    context.strokeStyle = this.colour('card');
    context.lineWidth = 2;
    context.beginPath();
    this.trace(context, [[13, 0], [-8, 8], [-4, 0], [-8, -8]], true);
    context.fill();
    context.stroke();
    context.restore();
  }

  paintChosen(context) {
    if (!this.chosen) return;
    const { kind, item } = this.chosen;
    const walks = kind === 'room' ? [item.outline_m] : kind === 'door' || kind === 'loop' ? [[item.from_m, item.to_m]]
      : [...item.extent.outlines, ...item.extent.lines];
    context.strokeStyle = this.colour('chosen');
    context.lineWidth = 3 / this.scale;
    context.beginPath();
    for (const walk of walks) this.trace(context, walk, kind === 'room' || walk.length > 2);
    if (walks.length === 0) context.arc(item.position_m[0], item.position_m[1], 10 / this.scale, 0, 2 * Math.PI);
    context.stroke();
  }

  // Names are in pixels, and one that would lie over another is left out.
  paintNames(context, width, height) {
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    const taken = [];
    const write = (text, [x, y], font, colour) => {
      context.font = font;
      const half = context.measureText(text).width / 2 + 3, px = width / 2 + (x - this.middle[0]) * this.scale;
      const py = height / 2 - (y - this.middle[1]) * this.scale;
      if (taken.some((box) => Math.abs(box[0] - px) < box[2] + half && Math.abs(box[1] - py) < 15)) return;
      taken.push([px, py, half]);
      context.lineWidth = 3;
      context.strokeStyle = this.colour('card');
      context.strokeText(text, px, py);
      context.fillStyle = colour;
      context.fillText(text, px, py);
    };
    const text = this.colour('text'), soft = this.colour('soft');
    if (!this.hidden.has('rooms'))
      for (const room of this.map.rooms) write(room.name, room.centre_m, '600 14px system-ui, sans-serif', text);
    const shown = (place) => givenName(place) ?? place.caption;
    for (const place of this.map.places)
      if (shown(place) && !this.isHidden(place)) write(shown(place), place.position_m, '12px system-ui, sans-serif', text);
    if (this.scale > 45)
      for (const place of this.map.places)
        if (!shown(place) && !this.isHidden(place) && place.label !== 'wall' && !this.map.labels[place.label].covers_the_plan)
          write(place.label, place.position_m, '11px system-ui, sans-serif', soft);
  }

  paintScale(context, width, height) {
    const wanted = 90 / this.scale, power = 10 ** Math.floor(Math.log10(wanted));
    const metres = [5, 2, 1].map((factor) => factor * power).find((each) => each <= wanted);
    const length = metres * this.scale, x = 14, y = height - 16;
    context.strokeStyle = context.fillStyle = this.colour('text');
    context.lineWidth = 1.5;
    context.beginPath();
    this.trace(context, [[x, y - 5], [x, y], [x + length, y], [x + length, y - 5]], false);
    context.stroke();
    context.textAlign = 'left';
    context.font = '12px system-ui, sans-serif';
    context.fillText(`${metres} m`, x + 4, y - 10);
  }
}

// The least rank is meant most likely: what is hit and small, then what is near. `miss` is 1 at the reach of a finger.
function rankOf(miss, outlines) {
  const area = outlines.reduce((sum, outline) => sum + areaOf(outline), 0);
  const size = area / (1 + area);
  return miss === 0 ? size : 0.5 + 0.5 * miss + 0.1 * size;
}

function rgbOf(colour) {
  const digits = colour.replace('#', '');
  return [0, 2, 4].map((at) => parseInt(digits.slice(at, at + 2), 16));
}
