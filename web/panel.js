// What is known of the thing that was touched, the answer to a question, and what can be changed.
import { row } from './list.js';
import { keyText, nameOf, valueText } from './names.js';
import { pictureAddress } from './server.js';

function element(name, text, className) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function button(text, onClick) {
  const made = element('button', text);
  made.type = 'button';
  made.addEventListener('click', onClick);
  return made;
}

const percent = (share) => `${Math.round(share * 100)} %`;
const position = ([x, y]) => `${x.toFixed(2)}, ${y.toFixed(2)} m`;

/** The panel beside the plan. `actions`: choose(chosen), change(words), showPath(points or null). */
export class Panel {
  constructor(box, actions) {
    this.box = box;
    this.actions = actions;
    this.map = null;
    this.mayChange = false;
    this.pending = null; // {verb, room or points} of a change that needs another touch
  }

  take(map, mayChange) {
    this.map = map;
    this.mayChange = mayChange;
  }

  show(chosen, point) {
    if (this.pending && point) return this.goOn(chosen, point);
    this.actions.showPath(null);
    if (!chosen) {
      this.box.replaceChildren(element('p', 'Touch a room or a thing to see what it is.', 'note'));
      return;
    }
    const parts = { room: () => this.room(chosen.item), door: () => this.door(chosen.item), place: () => this.place(chosen.item) };
    this.box.replaceChildren(element('h2', nameOf(chosen.kind, chosen.item)), ...parts[chosen.kind]());
  }

  facts(pairs) {
    const list = element('dl');
    for (const [key, value] of pairs) list.append(element('dt', key), element('dd', value));
    return list;
  }

  room(room) {
    const kind = room.kind ? `${room.kind} (${percent(room.kind_confidence)})` : 'not known';
    const facts = this.facts([
      ['number', room.id], ['area', `${room.area_m2.toFixed(1)} m²`], ['kind', kind],
      ['one whole room', percent(room.confidence)], ['seen to its walls', room.is_open ? 'no' : 'yes']]);
    const parts = [facts];
    if (room.evidence.length > 0) {
      parts.push(element('h3', 'Why it is called so'));
      const why = element('ul');
      for (const each of room.evidence) why.append(element('li', `${each.what} (${percent(each.confidence)})`));
      parts.push(why);
    }
    parts.push(...this.neighbours(room), ...this.roomChanges(room));
    return parts;
  }

  neighbours(room) {
    if (room.neighbours.length === 0) return [];
    const list = element('ul');
    for (const { id } of room.neighbours) {
      const other = this.map.rooms.find((each) => each.id === id);
      if (other) list.append(row('room', other, this.actions.choose));
    }
    return [element('h3', 'Next to it'), list];
  }

  roomChanges(room) {
    if (!this.mayChange) return [element('p', 'This page may only look.', 'note')];
    const form = element('form'), input = element('input'), save = element('button', 'Rename');
    input.value = room.name;
    input.maxLength = 200;
    input.setAttribute('aria-label', 'Name of the room');
    form.append(input, save);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.change(['rename', room.id, input.value.trim()]);
    });
    const buttons = element('div', undefined, 'row');
    buttons.append(
      button('Split', () => this.begin({ verb: 'split', points: [] }, 'Touch one end of the new wall.')),
      button('Merge', () => this.begin({ verb: 'merge', room }, 'Touch the room that it is to be one with.')),
      button('Delete', () => this.confirm(`Is ${room.name} no room?`, ['delete', room.id])));
    return [element('h3', 'Change'), form, buttons];
  }

  door(door) {
    const rooms = element('ul');
    for (const { id } of door.rooms) {
      const room = this.map.rooms.find((each) => each.id === id);
      if (room) rooms.append(row('room', room, this.actions.choose));
    }
    return [this.facts([['width', `${door.width_m.toFixed(2)} m`], ['confidence', percent(door.confidence)]]),
      element('h3', 'Between'), rooms];
  }

  place(place) {
    const properties = Object.entries(place.properties).map(([key, value]) => [keyText(key), valueText(key, value)]);
    const seen = Object.entries(place.seen_by).map(([sensor, count]) => `${count} × ${sensor}`).join(', ');
    const facts = this.facts([
      ['number', place.id], ['kind', place.kind],
      ['where', position(place.position_m) + (place.sigma_m === null ? '' : ` ± ${place.sigma_m.toFixed(3)} m`)],
      ['height', `${place.extent.bottom_m.toFixed(2)} to ${place.extent.top_m.toFixed(2)} m`],
      ['state', place.state], ['seen', seen || `${place.measurements} times`],
      ['last seen', place.last_seen ? new Date(place.last_seen).toLocaleString() : 'not known'], ...properties]);
    const parts = [facts];
    if (place.has_picture) {
      const picture = element('img');
      picture.alt = 'Picture of it';
      picture.src = pictureAddress(place.id);
      parts.unshift(picture);
    }
    const room = place.room && this.map.rooms.find((each) => each.id === place.room.id);
    if (room) {
      const list = element('ul');
      list.append(row('room', room, this.actions.choose));
      parts.push(element('h3', 'In'), list);
    }
    return parts;
  }

  /** Shows the answer to a question. */
  answer(text, { is_found: isFound, text: answer, answer: document }) {
    this.pending = null;
    const parts = [element('h2', text)], list = element('ul');
    for (const found of this.found(document ?? {})) list.append(row(found.kind, found.item, this.actions.choose));
    if (list.children.length > 0) parts.push(list);
    parts.push(element('pre', answer, isFound ? '' : 'bad'));
    this.box.replaceChildren(...parts);
    this.actions.showPath(document?.points_m ?? null);
  }

  // Things of this map that an answer names.
  found(document) {
    const ids = new Set();
    const collect = (value) => {
      if (Array.isArray(value)) value.forEach(collect);
      else if (value && typeof value === 'object') {
        if (typeof value.id === 'string') ids.add(value.id);
        else Object.values(value).forEach(collect);
      }
    };
    collect(document);
    const lists = [['room', this.map.rooms], ['place', this.map.places]];
    return lists.flatMap(([kind, items]) => items.filter((item) => ids.has(item.id)).map((item) => ({ kind, item })));
  }

  begin(pending, sentence) {
    this.pending = pending;
    this.box.replaceChildren(element('p', sentence), button('Cancel', () => {
      this.pending = null;
      this.show(null, null);
    }));
  }

  // A touch while a change waits for one.
  goOn(chosen, point) {
    const pending = this.pending;
    if (pending.verb === 'split') {
      pending.points.push(point.map((each) => each.toFixed(3)));
      if (pending.points.length === 1) return this.begin(pending, 'Touch the other end of the new wall.');
      return this.change(['split', ...pending.points.flat()]);
    }
    if (chosen?.kind !== 'room' || chosen.item.id === pending.room.id)
      return this.begin(pending, 'That is no other room. Touch the room that it is to be one with.');
    return this.change(['merge', pending.room.id, chosen.item.id]);
  }

  confirm(sentence, words) {
    const buttons = element('div', undefined, 'row');
    buttons.append(button('Yes', () => this.change(words)), button('No', () => this.show(null, null)));
    this.box.replaceChildren(element('p', sentence), buttons);
  }

  async change(words) {
    this.pending = null;
    this.box.replaceChildren(element('p', 'The map is being changed.', 'note'));
    try {
      await this.actions.change(words);
    } catch (error) {
      this.box.replaceChildren(element('p', error.message, 'bad'));
    }
  }
}
