// Rooms and what is in them, as a list that a keyboard and a screen reader reach.
import { nameOf } from './names.js';

/** The list of a map; `choose` is called with what is clicked. */
export function listOf(map, choose) {
  const list = document.createDocumentFragment();
  const section = (title, items, kind) => {
    if (items.length === 0) return;
    const heading = document.createElement('h3'), rows = document.createElement('ul');
    heading.textContent = title;
    for (const item of items) rows.append(row(kind, item, choose));
    list.append(heading, rows);
  };
  const shown = map.places.filter((place) => !map.labels[place.label].covers_the_plan && place.label !== 'wall');
  section('Rooms', map.rooms, 'room');
  for (const room of map.rooms)
    section(`In ${room.name}`, shown.filter((place) => place.room && place.room.id === room.id), 'place');
  section(map.rooms.length ? 'Elsewhere' : 'Landmarks', shown.filter((place) => !place.room), 'place');
  return list;
}

/** A list entry for one thing. */
export function row(kind, item, choose) {
  const entry = document.createElement('li'), button = document.createElement('button'), small = document.createElement('small');
  button.textContent = nameOf(kind, item);
  small.textContent = kind === 'room' ? ` ${item.area_m2.toFixed(1)} m²` : ` ${item.id}`;
  button.append(small);
  button.addEventListener('click', () => choose({ kind, item }));
  entry.append(button);
  return entry;
}
