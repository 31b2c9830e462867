// How things are called.

export function nameOf(kind, item) {
  if (kind !== 'place') return item.name ?? item.id;
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
