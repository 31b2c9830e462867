// Corrections of a map: landmarks that are none are deleted, and loop closures that are wrong are forbidden.
import { button, element } from './elements.js';

const LATER = 'It takes effect with the next log that continues the map (omnimapper-graphslam --continue).';

/** What deletes a thing; `actions`: correct(words, words of the undo), confirm(sentence, act). */
export function deletionOf(place, called, actions) {
  const row = element('div', undefined, 'row');
  row.append(button('Delete it from the map', () => actions.confirm(
    `Is ${called} nothing that is there? It is not shown or found any more, also when the map is continued.`,
    () => actions.correct(['delete', place.id], ['restore', place.id]))));
  return [element('h3', 'Correct the map'), row];
}

/** What forbids a loop closure, or allows it again. */
export function forbiddingOf(loop, actions) {
  const [from, to] = loop.key_frames, row = element('div', undefined, 'row');
  const forbid = ['forbid', from, to], allow = ['allow', from, to];
  row.append(loop.is_forbidden ? button('Allow it again', () => actions.correct(allow, forbid))
    : button('Forbid it', () => actions.correct(forbid, allow)));
  return [element('h3', 'Correct the map'), row, element('p', LATER, 'note')];
}

/** The things that people deleted, with a button for each that brings it back. */
export function deletedThings(map, mayChange, actions) {
  if (map.deleted.length === 0) return [];
  const list = element('ul');
  for (const thing of map.deleted) {
    const entry = element('li', `${thing.label} ${thing.id}`, 'entry');
    if (mayChange)
      entry.append(button('Bring it back', () => actions.correct(['restore', thing.id], ['delete', thing.id])));
    list.append(entry);
  }
  return [element('h3', 'Deleted by people'), list];
}
