// Changes between the plan and the view in 3D, whose data are fetched when it is shown first.
import { readPly } from './ply.js';
import { Solid } from './solid.js';
import { source } from './source.js';

/** `button` changes the view; `plan` is what is seen first, and knows the map. */
export class Dimension {
  constructor(canvas, button, plan) {
    Object.assign(this, { canvas, button, plan, solid: null, shown: null });
  }

  get isSolid() {
    return !this.canvas.hidden;
  }

  /** Throws an Error with a sentence if there is nothing to show, or the browser cannot. */
  async toggle() {
    if (this.isSolid) return this.set(false);
    this.set(true);
    try {
      await this.fill();
    } catch (error) {
      this.set(false);
      throw error;
    }
  }

  set(isSolid) {
    this.canvas.hidden = !isSolid;
    this.button.textContent = isSolid ? 'Plan' : '3D';
    this.button.setAttribute('aria-pressed', String(isSolid));
  }

  // Fetches what is new since the view was shown last.
  async fill() {
    const { map, trajectory } = this.plan;
    if (this.shown === map.revision) return this.choose(this.plan.chosen);
    const [points, surfaces] = await Promise.all(['points', 'surfaces'].map((name) => source.ply(name, map.revision)));
    if (!points && !surfaces) throw new Error('This map has no view in 3D: its run wrote neither points.ply nor landmarks.ply.');
    this.solid ??= new Solid(this.canvas);
    this.solid.show(points && readPly(points), surfaces && readPly(surfaces), trajectory);
    if (this.shown === null) this.solid.showAll(this.plan.bounds());
    this.shown = map.revision;
    this.choose(this.plan.chosen);
    this.canvas.dataset.revision = map.revision;
  }

  refresh() {
    return this.isSolid ? this.fill() : undefined;
  }

  choose(chosen) {
    if (this.isSolid) this.solid?.choose(chosen?.kind === 'place' ? boxOf(chosen.item) : null);
  }

  zoom(factor) {
    (this.isSolid && this.solid ? this.solid : this.plan).zoom(factor);
  }

  showAll() {
    if (this.isSolid && this.solid) this.solid.showAll(this.plan.bounds());
    else this.plan.showAll();
  }
}

function boxOf({ position_m: position, extent }) {
  const points = [position, ...extent.points, ...extent.outlines.flat(), ...extent.lines.flat()];
  const of = (least, axis) => least(...points.map((point) => point[axis]));
  return { min: [of(Math.min, 0), of(Math.min, 1), extent.bottom_m], max: [of(Math.max, 0), of(Math.max, 1), extent.top_m] };
}
