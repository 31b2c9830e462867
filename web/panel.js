// What is known of the thing that was touched, the answer to a question, and what can be changed.
import { deletionOf, forbiddingOf } from './corrections.js';
import { button, element, field } from './elements.js';
import { goThere } from './goals.js';
import { labelsOf, spotLabels } from './labels.js';
import { row } from './list.js';
import { isName, keyText, nameOf, valueText } from './names.js';
import { source } from './source.js';

const HINT = 'Touch a room or a thing to see what it is';
const percent = (share) => `${Math.round(share * 100)} %`;
const position = ([x, y]) => `${x.toFixed(2)}, ${y.toFixed(2)} m`;

/**
 * The panel beside the plan. `actions`: choose(chosen), chooseAgain() what is chosen, change(words) of rooms,
 * label(words), correct(words), showPath(points or null).
 */
export class Panel {
  constructor(box, actions) {
    this.box = box;
    this.actions = actions;
    this.map = null;
    this.mayChange = this.mayDrive = false;
    this.isAnswer = false; // it shows the answer to a question
    this.pending = null; // {verb, room or points} of a change that needs another touch
  }

  /** `rights` as source.rights() has them. */
  take(map, rights) {
    this.map = map;
    this.mayChange = rights.may_change;
    this.mayDrive = rights.may_drive;
  }

  show(chosen, point) {
    if (this.pending && point) return this.goOn(chosen, point);
    this.actions.showPath(null);
    this.isAnswer = false;
    const spot = point && this.mayChange && chosen?.kind !== 'place'
      ? spotLabels(point, this.map, (words) => this.label(words)) : [];
    if (!chosen) return this.fill(element('p', HINT + (this.mayChange ? ', and to name or correct it.' : '.'), 'note'), ...spot);
    const parts = { room: () => this.room(chosen.item), door: () => this.door(chosen.item),
      place: () => this.place(chosen.item), loop: () => this.loop(chosen.item) };
    const goal = chosen.kind === 'place' ? [] : this.goal(chosen); // of a thing, the name comes first
    this.fill(element('h2', nameOf(chosen.kind, chosen.item)), ...goal, ...parts[chosen.kind](), ...spot);
  }

  goal({ kind, item }) {
    if (!this.mayDrive || kind === 'door' || kind === 'loop') return [];
    const buttons = element('div', undefined, 'row');
    buttons.append(goThere(kind === 'place' && isName(item) ? item.label : item.id, nameOf(kind, item), {
      show: (...parts) => this.fill(...parts),
      showPath: this.actions.showPath,
      carryOut: (words, act) => this.carryOut(words, act),
    }));
    return [buttons];
  }

  /** Shows the thing again, as it is in a map that was read again. What came of the last change stays. */
  refresh(chosen) {
    const done = this.box.querySelector('.done'), scrolled = this.box.parentElement.scrollTop;
    this.show(chosen, null);
    if (done) this.box.prepend(done);
    this.box.parentElement.scrollTop = scrolled;
  }

  /** Whether somebody types into it. */
  get isTypedInto() {
    return this.box.contains(document.activeElement) && document.activeElement.matches('input');
  }

  fill(...parts) {
    this.box.replaceChildren(...parts);
    this.box.parentElement.scrollTop = 0;
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
    if (!this.mayChange) return [onlyLooks()];
    const form = field('Name of the room', room.name, 'Rename', (text) => this.change(['rename', room.id, text]));
    const buttons = element('div', undefined, 'row');
    buttons.append(
      button('Split', () => this.begin({ verb: 'split', points: [] }, 'Touch one end of the new wall.')),
      button('Merge', () => this.begin({ verb: 'merge', room }, 'Touch the room that it is to be one with.')),
      button('Delete', () => this.confirm(`Is ${room.name} no room?`, () => this.change(['delete', room.id]))));
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
    const properties = Object.entries(place.properties).filter(([key]) => key !== 'name').map(([key, value]) => [keyText(key), valueText(key, value)]);
    const seen = Object.entries(place.seen_by).map(([sensor, count]) => `${count} × ${sensor}`).join(', ');
    const facts = this.facts([
      ['number', place.id], ['kind', place.kind], ...(place.why ? [['why', place.why]] : []),
      ['where', position(place.position_m) + (place.sigma_m === null ? '' : ` ± ${place.sigma_m.toFixed(3)} m`)],
      ['height', `${place.extent.bottom_m.toFixed(2)} to ${place.extent.top_m.toFixed(2)} m`],
      ['state', place.state], ['seen', seen || `${place.measurements} times`],
      ['last seen', place.last_seen ? new Date(place.last_seen).toLocaleString() : 'not known'], ...properties]);
    const parts = [facts];
    if (place.has_picture) {
      const picture = element('img');
      picture.alt = 'Picture of it';
      picture.src = source.pictureAddress(place.id);
      parts.unshift(picture);
    }
    const room = place.room && this.map.rooms.find((each) => each.id === place.room.id);
    if (room) {
      const list = element('ul');
      list.append(row('room', room, this.actions.choose));
      parts.push(element('h3', 'In'), list);
    }
    return [...this.labels(place), ...this.goal({ kind: 'place', item: place }), ...parts, ...this.deletion(place)];
  }

  deletion(place) {
    return this.mayChange && !isName(place) ? deletionOf(place, nameOf('place', place), this) : [];
  }

  loop(loop) {
    const facts = this.facts([['key frames', loop.key_frames.join(' and ')],
      ['distance', `${Math.hypot(loop.from_m[0] - loop.to_m[0], loop.from_m[1] - loop.to_m[1]).toFixed(2)} m`],
      ['found by', loop.closed_by], ['why', loop.why || 'not known'],
      ['state', loop.is_forbidden ? 'forbidden' : 'the map rests on it']]);
    return [element('p', 'The robot was here twice: what it measured then ties these two moments together.', 'note'), facts,
      ...(this.mayChange ? forbiddingOf(loop, this) : [onlyLooks()])];
  }

  labels(place) {
    return this.mayChange ? labelsOf(place, this.map, (words) => this.label(words)) : [onlyLooks()];
  }

  /** Shows the answer to a question. */
  answer(text, { is_found: isFound, text: answer, answer: document }) {
    this.pending = null;
    this.isAnswer = true;
    const parts = [element('h2', text)], list = element('ul');
    for (const found of this.found(document ?? {})) list.append(row(found.kind, found.item, this.actions.choose));
    if (list.children.length > 0) parts.push(list);
    parts.push(element('pre', answer, isFound ? '' : 'bad'));
    this.fill(...parts);
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
    this.fill(element('p', sentence), button('Cancel', () => {
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

  confirm(sentence, act) {
    const buttons = element('div', undefined, 'row');
    buttons.append(button('Yes', act), button('No', () => this.actions.chooseAgain()));
    this.fill(element('p', sentence), buttons);
  }

  change(words) {
    return this.carryOut(words, () => this.actions.change(words));
  }

  /** Corrects the map; `undo` are the words that take it back. */
  async correct(words, undo) {
    await this.carryOut(words, () => this.actions.correct(words), [button('Undo', () => this.correct(undo, words))]);
  }

  async label(words) {
    const undo = words[0] === 'undo' ? [] : [button('Undo', () => this.label(['undo']))];
    await this.carryOut(words, () => this.actions.label(words), undo);
  }

  // Shows a change as heard, then what came of it, or why it did not.
  async carryOut(words, act, buttons = []) {
    this.pending = null;
    const heard = element('p', `Heard: ${words.join(' ')}`, 'note');
    heard.setAttribute('role', 'status');
    this.box.prepend(heard);
    this.box.parentElement.scrollTop = 0;
    try {
      const done = element('div', await act(), 'done');
      done.setAttribute('role', 'status');
      done.append(...buttons);
      heard.remove();
      this.box.prepend(done);
    } catch (error) {
      heard.replaceWith(element('p', error.message, 'bad'));
    }
  }
}

function onlyLooks() {
  return element('p', source.onlyLooks, 'note');
}
