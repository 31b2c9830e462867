// The list of what the plan shows.
import { LOOPS } from './loops.js';

const FIXED = [['grid', 'Free space and walls seen'], ['rooms', 'Rooms'], ['doors', 'Doors'],
  ['trajectory', 'Where the robot drove'], ['robot', 'Robot'], [LOOPS, 'Loop closures']];

/** Fills a box with a tick for each layer of the map and each label of its things. */
export function paintLayers(box, map, plan) {
  const labels = Object.keys(map.labels).sort().map((label) => ['label ' + label, label, map.labels[label].colour]);
  box.replaceChildren(...[...FIXED, ...labels].map(([key, text, colour]) => {
    const row = document.createElement('label'), tick = document.createElement('input');
    tick.type = 'checkbox';
    tick.checked = !plan.hidden.has(key);
    tick.addEventListener('change', () => {
      if (tick.checked) plan.hidden.delete(key);
      else plan.hidden.add(key);
      plan.draw();
    });
    row.append(tick);
    if (colour) {
      const swatch = document.createElement('i');
      swatch.style.background = colour;
      row.append(swatch);
    }
    row.append(text);
    return row;
  }));
}
