// The page of a map: plan, search, what is touched, and changes of rooms.
import { aboutOf } from './about.js';
import { Dimension } from './dimension.js';
import { Panel } from './panel.js';
import { Plan } from './plan.js';
import { paintLayers } from './layers.js';
import { listOf } from './list.js';
import { isName } from './names.js';
import { source } from './source.js';

const byId = (id) => document.getElementById(id);
const state = byId('state');
let map = null, hadRight = false;

const plan = new Plan(byId('plan'), (touched, point) => choose(touched, point));
const view = new Dimension(byId('solid'), byId('names'), byId('dimension'), plan);
const panel = new Panel(byId('panel'), {
  choose: (chosen) => choose(chosen, null, true),
  change: (words) => change(() => source.edit(words)),
  chooseAgain: () => choose(plan.chosen),
  label: (words) => change(() => source.label(words)),
  correct: (words) => change(() => source.correct(words)),
  showPath: (walk) => {
    plan.path = walk;
    plan.draw();
  },
});

// Has the server change the map; what was done, in words.
async function change(ask) {
  const done = await ask();
  await load(true);
  return done;
}

function say(sentence, isBad = false) {
  state.textContent = sentence;
  state.classList.toggle('bad', isBad);
}

function choose(chosen, point, isToLookAt = false) {
  plan.choose(chosen);
  panel.show(chosen, point);
  view.choose(chosen);
  if (chosen && isToLookAt) plan.lookAt(middleOf(chosen));
}

function middleOf({ kind, item }) {
  if (kind === 'room') return item.centre_m;
  if (kind === 'door' || kind === 'loop') return [(item.from_m[0] + item.to_m[0]) / 2, (item.from_m[1] + item.to_m[1]) / 2];
  return item.position_m;
}

// The same thing in the map that was read again.
function again(chosen) {
  if (!chosen) return null;
  const lists = { room: map.rooms, door: map.doors, place: map.places, loop: map.loops };
  const isSame = (each) => each.id === chosen.item.id && (!isName(each) || each.label === chosen.item.label);
  const item = lists[chosen.kind].find(isSame);
  return item ? { kind: chosen.kind, item } : null;
}

// `isOwn`: after a change of this page; a change of another page must not take away what is being typed.
async function load(isOwn = false) {
  map = await source.mapDocument();
  const [walk, image, rights, about] = await Promise.all([
    source.trajectory(), map.grid ? source.gridImage(map.revision) : null, source.rights(), source.about()]);
  plan.show(map, image, walk);
  panel.take(map, rights);
  byId('stop').hidden = !rights.may_drive;
  hadRight ||= rights.may_change;
  byId('lost').hidden = !hadRight || rights.may_change;
  paintLayers(byId('toggles'), map, plan);
  byId('about').replaceChildren(...aboutOf(map, about, rights.may_change, {
    choose: (chosen) => choose(chosen, null, true), correct: (words, undo) => panel.correct(words, undo) }));
  byId('list').replaceChildren(listOf(map, (chosen) => choose(chosen, null, true)));
  plan.choose(again(plan.chosen));
  if (!panel.pending && !panel.isAnswer && (isOwn || !panel.isTypedInto)) panel.refresh(plan.chosen);
  const time = map.map_time ? new Date(map.map_time) : null;
  const isDated = time && time.getFullYear() > 1990; // the clock of some logs begins at 0
  say(`${map.is_growing ? 'The run goes on: ' : ''}${map.rooms.length} rooms, ${map.places.length} landmarks${isDated ? `, as of ${time.toLocaleString()}` : ''}`);
  await view.refresh().catch((error) => say(error.message, true)); // the map is drawn all the same
}

async function find(text) {
  if (!text) return;
  try {
    panel.answer(text, await source.question(text));
  } catch (error) {
    panel.answer(text, { is_found: false, text: error.message, answer: {} });
  }
}

byId('search').addEventListener('submit', (event) => {
  event.preventDefault();
  find(byId('question').value.trim());
});
byId('stop').addEventListener('click', () => panel.carryOut(['stop'], source.stop));
byId('closer').addEventListener('click', () => view.zoom(1.4));
byId('farther').addEventListener('click', () => view.zoom(1 / 1.4));
byId('all').addEventListener('click', () => view.showAll());
byId('dimension').addEventListener('click', () => view.toggle().catch((error) => say(error.message, true)));

source.listen(
  async (revision) => {
    if (map && map.revision === revision && !state.classList.contains('bad')) return;
    try {
      await load();
      document.documentElement.dataset.revision = revision;
    } catch (error) {
      say(error.message, true);
    }
  },
  () => say('The server is not reached; the map is as it was last.', true));
