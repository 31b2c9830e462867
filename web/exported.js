// A map that omnimapper-export wrote beside the page: the same functions as server.js, without a server.

const data = () => globalThis.omnimapperMap;
const refuse = async () => {
  throw new Error(onlyLooks);
};

export const onlyLooks = 'This page is a copy of a map: it may only look.';

export const mapDocument = async () => data().map;
export const trajectory = async () => data().trajectory;
export const rights = async () => ({ may_change: false, may_drive: false });
export const pictureAddress = (id) => `picture-${id.replace(':', '-')}.png`;
export const about = async () => data().about;
export const [edit, label, correct, ticket, goTo, stop] = Array(6).fill(refuse);

export async function gridImage() {
  const image = new Image();
  image.src = data().grid;
  await image.decode();
  return image;
}

/** Rooms and things whose name, kind or number has the words. */
export async function question(text) {
  const asked = text.toLowerCase();
  const has = (...names) => names.some((name) => typeof name === 'string' && name.toLowerCase().includes(asked));
  const { rooms, places } = data().map;
  const found = [...rooms.filter((room) => has(room.id, room.name, room.kind)),
    ...places.filter((place) => has(place.id, place.label, place.caption, ...Object.values(place.properties)))];
  const count = found.length === 0 ? 'Nothing has' : found.length === 1 ? 'One has' : `${found.length} have`;
  return { is_found: found.length > 0, text: `${count} this name. A copy of a map knows no paths.`, answer: { matches: found } };
}

/** The map of a copy does not change. */
export function listen(onRevision) {
  onRevision(data().map.revision);
}
