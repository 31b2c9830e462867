// Changes between the plan and the view in 3D, whose data are fetched when it is shown first.
import { readPly } from './ply.js';
import { Solid } from './solid.js';
import { namesOf } from './solidNames.js';
import { source } from './source.js';

/** `names` is the canvas above `canvas`; `button` changes the view; `plan` is what is seen first, and knows the map. */
export class Dimension {
  constructor(canvas, names, button, plan) {
    Object.assign(this, { canvas, names, button, plan, solid: null, files: null, shown: null });
  }

  get isSolid() {
    return !this.canvas.hidden;
  }

  /** Throws an Error with a sentence if the files do not come, or the browser cannot show them. */
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
    this.canvas.hidden = this.names.hidden = !isSolid;
    this.button.textContent = isSolid ? 'Plan' : '3D';
    this.button.setAttribute('aria-pressed', String(isSolid));
  }

  // Fetches the files of the view unless they were fetched before.
  async fill() {
    const { map, trajectory } = this.plan;
    if (this.shown === map) return this.choose(this.plan.chosen);
    this.solid ??= new Solid(this.canvas, this.names);
    if (this.files?.solid !== map.solid) {
      const [points, surfaces] = await Promise.all(['points', 'surfaces'].map((name) => source.ply(name, map.solid)));
      this.files = { solid: map.solid, points: points && readPly(points), surfaces: surfaces && readPly(surfaces) };
    }
    this.solid.show(this.files.points, this.files.surfaces, trajectory, namesOf(map));
    if (this.shown === null) this.solid.showAll(this.plan.bounds());
    this.shown = map;
    this.choose(this.plan.chosen);
    this.canvas.dataset.revision = map.revision;
  }

  /** After another map was read. Without files of the view in 3D there is no button. */
  async refresh() {
    const { map } = this.plan;
    this.button.hidden = !map.solid;
    if (!map.solid) this.set(false);
    if (this.isSolid) await this.fill();
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
