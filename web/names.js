// How things are called.

/** Whether a place is no thing but a name: of a spot, or of several things. */
export const isName = (place) => place.kind === 'place' || place.kind === 'region';

/** The name that somebody gave to a place; undefined if nobody did. */
export const givenName = (place) => (isName(place) ? place.label : place.properties.name);

export function nameOf(kind, item) {
  if (kind === 'loop') return 'loop closure';
  if (kind !== 'place') return item.name ?? item.id;
  if (isName(item)) return `"${item.label}"`;
  const name = item.properties.name ?? item.caption;
  return name ? `${item.label} "${name}"` : item.label;
}

/** "12.30 m" for a key that ends in its unit; the plain value else. */
export function valueText(key, value) {
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value !== 'number') return String(value);
  const [, unit] = key.match(/_(m|m2|deg|kg|s|rad)$/) ?? [];
  const text = Number.isInteger(value) ? String(value) : value.toFixed(2);
  return unit ? `${text} ${unit.replace('m2', 'm²')}` : text;
}

/** "wall thickness" for the key "wall_thickness_m". */
export const keyText = (key) => key.replace(/_(m|m2|deg|kg|s|rad)$/, '').replaceAll('_', ' ');
