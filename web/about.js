// What is known of the whole map: whether it is good, the sessions, the sensors, what changed, and what is not there yet.
import { deletedThings } from './corrections.js';
import { element } from './elements.js';
import { row } from './list.js';

const NOT_YET = 'Not available yet: follow me, standby, moving things, and people on the map.';

/** The parts of the box. `about` as source.about() has it; `actions`: choose(chosen), correct(words, words of the undo). */
export function aboutOf(map, about, mayChange, actions) {
  return [...verdictOf(map, about), ...sessionsOf(about), ...sensorsOf(map, about), ...changesOf(map, actions),
    ...deletedThings(map, mayChange, actions), element('h3', 'What this page cannot do'), element('p', NOT_YET, 'note')];
}

function verdictOf(map, about) {
  if (map.is_growing) return [element('p', 'The run that makes this map goes on.')];
  if (!about.verdict) return [];
  const parts = [element('h3', 'Is the map right?'), element('p', about.verdict.sentence)];
  if (about.closures)
    parts.push(element('p', `Loop closures of the last session: ${about.closures.accepted} accepted, `
      + `${about.closures.refused} refused. The layer "Loop closures" shows those that the map rests on.`, 'note'));
  return parts;
}

function sessionsOf(about) {
  if (!about.sessions?.length) return [];
  const list = element('ul');
  for (const session of about.sessions) {
    const facts = [`${session.key_frames ?? 0} key frames`];
    if (session.travel_m !== undefined) facts.push(`${session.travel_m.toFixed(1)} m`);
    if (session.log_s !== undefined) facts.push(`${Math.round(session.log_s)} s`);
    if (!session.aligned) facts.push('where it is in the map is not known');
    list.append(element('li', `${session.number}: ${session.title} (${facts.join(', ')})`, 'entry'));
  }
  return [element('h3', 'Sessions'), list];
}

// Of a run on live sensors their state is known, and of a log how often each saw what is in the map.
function sensorsOf(map, about) {
  const list = element('ul'), counts = new Map();
  for (const { name, state, observations } of about.sensors ?? [])
    list.append(element('li', `${name}: ${state}, ${observations} observations`, 'entry'));
  if (!about.sensors) {
    for (const place of map.places)
      for (const [sensor, count] of Object.entries(place.seen_by)) counts.set(sensor, (counts.get(sensor) ?? 0) + count);
    for (const [sensor, count] of counts) list.append(element('li', `${sensor}: ${count} measurements of landmarks`, 'entry'));
  }
  return list.children.length ? [element('h3', 'Sensors'), list] : [];
}

function changesOf(map, actions) {
  const moved = map.places.filter((place) => place.state === 'moved');
  if (moved.length === 0) return [];
  const list = element('ul');
  for (const item of moved) list.append(row('place', item, actions.choose));
  return [element('h3', 'Moved or gone since it was seen'), list];
}
