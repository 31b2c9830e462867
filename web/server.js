// What the page asks the server for. Each function throws an Error with a sentence for people.

async function ask(address, options) {
  let answer;
  try {
    answer = await fetch(address, options);
  } catch {
    throw new Error('The server does not answer.');
  }
  if (!answer.ok) throw new Error((await answer.text()).trim() || `The server refused (${answer.status}).`);
  return answer;
}

export const mapDocument = async () => (await ask('api/map')).json();
export const trajectory = async () => (await ask('api/trajectory')).json();
export const mayChange = async () => (await (await ask('api/me')).json()).may_change;
export const question = async (text) => (await ask('api/query?q=' + encodeURIComponent(text))).json();
export const pictureAddress = (id) => 'api/picture?id=' + encodeURIComponent(id);

/** The picture of the occupancy grid. */
export async function gridImage(revision) {
  const image = new Image();
  image.src = 'api/grid?revision=' + revision;
  await image.decode();
  return image;
}

async function change(address, words) {
  const answer = await ask(address, {
    method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify({ words }),
  });
  return (await answer.json()).done;
}

/** Changes rooms; `words` as omnimapper-rooms MAP edit takes them. What was done, in words. */
export const edit = (words) => change('api/edit', words);

/** Changes names: name ID TEXT, name X Y TEXT, rename OLD NEW, delete TEXT, undo. What was done, in words. */
export const label = (words) => change('api/label', words);

/** Calls `onRevision` with the number of each map that the server reads, and `onLost` while it is not reached. */
export function listen(onRevision, onLost) {
  const events = new EventSource('api/events');
  events.addEventListener('message', (event) => onRevision(JSON.parse(event.data).revision));
  events.addEventListener('error', () => onLost());
}
