// Loop closures on the plan: lines between the places where the robot was twice.
import { distanceToSegment } from './geometry.js';

export const LOOPS = 'loops'; // the layer

/** Draws the loop closures of a plan, whose context is in metres. */
export function paintLoops(plan, context) {
  for (const loop of plan.map.loops) {
    context.setLineDash(loop.is_forbidden ? [4 / plan.scale, 6 / plan.scale] : []);
    plan.paintPath(context, [loop.from_m, loop.to_m], plan.colour(loop.is_forbidden ? 'bad' : 'door'), 2, 0.8);
    context.setLineDash([]);
    context.fillStyle = plan.colour(loop.is_forbidden ? 'bad' : 'door');
    for (const [x, y] of [loop.from_m, loop.to_m]) {
      context.beginPath();
      context.arc(x, y, 3 / plan.scale, 0, 2 * Math.PI);
      context.fill();
    }
  }
}

/** The loop closure nearest to a point; null if none is within `reach` [m]. */
export function loopAt(plan, point, reach) {
  let best = null, least = reach;
  for (const loop of plan.map.loops) {
    const distance = distanceToSegment(point, loop.from_m, loop.to_m);
    if (distance < least) [best, least] = [loop, distance];
  }
  return best && { kind: 'loop', item: best };
}
