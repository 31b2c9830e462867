// Plane geometry in the frame of the map [m]; points are [x, y].

/** Whether a point lies in a closed path. */
export function isInside(point, path) {
  let inside = false;
  for (let i = 0, j = path.length - 1; i < path.length; j = i++) {
    const [xi, yi] = path[i], [xj, yj] = path[j];
    if (yi > point[1] !== yj > point[1] && point[0] < ((xj - xi) * (point[1] - yi)) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

/** Distance of a point from the segment between two others. */
export function distanceToSegment(point, from, to) {
  const dx = to[0] - from[0], dy = to[1] - from[1];
  const length2 = dx * dx + dy * dy;
  const along = length2 > 0 ? ((point[0] - from[0]) * dx + (point[1] - from[1]) * dy) / length2 : 0;
  const t = Math.min(1, Math.max(0, along));
  return Math.hypot(point[0] - from[0] - t * dx, point[1] - from[1] - t * dy);
}

/** Distance of a point from a path; 0 inside one that is closed and has an area. */
export function distanceToPath(point, path, closed) {
  if (path.length === 0) return Infinity;
  if (path.length === 1) return Math.hypot(point[0] - path[0][0], point[1] - path[0][1]);
  if (closed && path.length > 2 && isInside(point, path)) return 0;
  let least = Infinity;
  for (let i = closed ? 0 : 1; i < path.length; ++i)
    least = Math.min(least, distanceToSegment(point, path[(i || path.length) - 1], path[i]));
  return least;
}

/** Distance of a point from the extent of a place. */
export function distanceToPlace(point, place) {
  const { outlines, lines, points } = place.extent;
  let least = Math.hypot(point[0] - place.position_m[0], point[1] - place.position_m[1]);
  for (const outline of outlines) least = Math.min(least, distanceToPath(point, outline, true));
  for (const line of lines) least = Math.min(least, distanceToPath(point, line, false));
  for (const each of points) least = Math.min(least, distanceToPath(point, [each], false));
  return least;
}

/** Area of a closed path [m^2]. */
export function areaOf(path) {
  let doubled = 0;
  for (let i = 0, j = path.length - 1; i < path.length; j = i++) doubled += path[j][0] * path[i][1] - path[i][0] * path[j][1];
  return Math.abs(doubled) / 2;
}
