// The names of rooms and things in the view in 3D, on a canvas above it.
import { givenName } from './names.js';

const WIDEST = 24; // letters

/** What is named, with the point [m] at which its name is written; rooms come first. */
export function namesOf(map) {
  const short = (text) => (text.length > WIDEST ? text.slice(0, WIDEST - 1) + '\u2026' : text);
  const rooms = map.rooms.map(({ name, centre_m: [x, y] }) => ({ text: short(name), at: [x, y, 0.1], isRoom: true }));
  const things = map.places.map((place) => ({ text: givenName(place) ?? place.caption, place })).filter(({ text }) => text)
    .map(({ text, place }) => ({ text: short(text), at: [...place.position_m.slice(0, 2), place.extent.top_m + 0.1], isRoom: false }));
  return [...rooms, ...things];
}

/** Writes names; one that would lie over another is left out. `screen`: from the map to the view, 4 x 4 by columns. */
export function writeNames(canvas, names, screen) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.max(1, width * ratio);
  canvas.height = Math.max(1, height * ratio);
  const context = canvas.getContext('2d'), style = getComputedStyle(document.documentElement), taken = [];
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const { text, at, isRoom } of names) {
    const [x, y, , w] = [0, 1, 2, 3].map((row) => [...at, 1].reduce((sum, each, i) => sum + screen[4 * i + row] * each, 0));
    if (w <= 0) continue; // behind the eye
    const px = (0.5 + x / w / 2) * width, py = (0.5 - y / w / 2) * height;
    context.font = isRoom ? '600 14px system-ui, sans-serif' : '12px system-ui, sans-serif';
    const half = context.measureText(text).width / 2 + 3;
    if (px < 0 || px > width || py < 0 || py > height) continue;
    if (taken.some((box) => Math.abs(box[0] - px) < box[2] + half && Math.abs(box[1] - py) < 15)) continue;
    taken.push([px, py, half]);
    context.lineWidth = 3;
    context.strokeStyle = style.getPropertyValue('--card');
    context.strokeText(text, px, py);
    context.fillStyle = style.getPropertyValue('--text');
    context.fillText(text, px, py);
  }
  canvas.dataset.written = taken.length;
}
