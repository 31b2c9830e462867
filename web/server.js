// What the page asks the server for. Each function throws an Error with a sentence for people.

async function reach(address, options) {
  try {
    return await fetch(address, options);
  } catch {
    throw new Error('The server does not answer.');
  }
}

async function ask(address, options) {
  const answer = await reach(address, options);
  if (!answer.ok) throw new Error((await answer.text()).trim() || `The server refused (${answer.status}).`);
  return answer;
}

export const mapDocument = async () => (await ask('api/map')).json();
export const trajectory = async () => (await ask('api/trajectory')).json();
export const onlyLooks = 'This page may only look; the address that omnimapper-serve printed may change the map.';

/** What this page may do: may_change the map, may_drive the robot of a live run. */
export const rights = async () => (await ask('api/me')).json();
/** What the run says about itself: title, sessions, verdict, closures, sensors, as far as they are there. */
export const about = async () => (await ask('api/about')).json();
export const question = async (text) => (await ask('api/query?q=' + encodeURIComponent(text))).json();
export const pictureAddress = (id) => 'api/picture?id=' + encodeURIComponent(id);

/** The bytes of a PLY file of the map, "points" or "surfaces"; null if it has none. `solid` is that of the map. */
export async function ply(name, solid) {
  const answer = await reach(`api/${name}?solid=${encodeURIComponent(solid)}`);
  if (answer.status === 404) return null;
  if (!answer.ok) throw new Error(`The server refused the ${name} of the view in 3D (${answer.status}).`);
  return answer.arrayBuffer();
}

/** The picture of the occupancy grid. */
export async function gridImage(revision) {
  const image = new Image();
  image.src = 'api/grid?revision=' + revision;
  await image.decode();
  return image;
}

async function post(address, words) {
  const answer = await ask(address, {
    method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ words }),
  });
  return answer.json();
}

const change = async (address, words) => (await post(address, words)).done;

/** Changes rooms; `words` as omnimapper-rooms MAP edit takes them. What was done, in words. */
export const edit = (words) => change('api/edit', words);

/** Changes names: name ID TEXT, name X Y TEXT, rename OLD NEW, delete TEXT, undo. What was done, in words. */
export const label = (words) => change('api/label', words);

/** Corrects the map; `words` as omnimapper-edit takes them. What was done, in words. */
export const correct = (words) => change('api/correct', words);

/** What lets one command to go somewhere through, within a minute. */
export const ticket = async () => (await post('api/ticket', [])).ticket;
export const goTo = (goal, ofTicket) => change('api/go', [goal, ofTicket]);
export const stop = () => change('api/stop', []);

/** Calls `onRevision` with the number of each map that the server reads, and `onLost` while it is not reached. */
export function listen(onRevision, onLost) {
  const events = new EventSource('api/events');
  events.addEventListener('message', (event) => onRevision(JSON.parse(event.data).revision));
  events.addEventListener('error', () => onLost());
}
