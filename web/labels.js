// What people named: names are given to things and to spots of the floor, renamed and deleted.
import { button, element, field } from './elements.js';
import { givenName } from './names.js';

const MOST_OFFERED = 8;

/** The names of a map, each once. */
export function namesIn(map) {
  return [...new Set(map.places.map(givenName).filter(Boolean))].sort();
}

/** What names a thing, or changes the name that it has; `change` takes the words of the change. */
export function labelsOf(place, map, change) {
  const name = givenName(place);
  if (!name) return naming('Name it', [place.id], map, change);
  return [element('h3', 'Name'), field('New name', name, 'Rename', (text) => change(['rename', name, text])),
    row([button(`Delete the name "${name}"`, () => change(['delete', name]))])];
}

/** What names a spot of the floor, [x, y]. */
export function spotLabels(point, map, change) {
  const details = element('details');
  details.append(element('summary', 'Name this spot'),
    ...naming('Name it', point.map((each) => each.toFixed(3)), map, change).slice(1));
  return [details];
}

function naming(action, what, map, change) {
  const give = (text) => change(['name', ...what, text]);
  const offered = namesIn(map).slice(0, MOST_OFFERED).map((name) => button(name, () => give(name)));
  const parts = [element('h3', 'Name'), field('Name', '', action, give)];
  if (offered.length > 0) parts.push(element('p', 'Names given earlier:', 'note'), row(offered));
  return parts;
}

function row(buttons) {
  const made = element('div', undefined, 'row');
  made.append(...buttons);
  return made;
}
