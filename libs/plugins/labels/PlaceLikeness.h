#pragma once

#include <omnimapper/geometry/Se2.h>
#include <omnimapper/map/Places.h>

namespace omnimapper::plugins {

/// How much two places look like the same thing, 0 to 1: the shares of the rim of each that is near to the other, seen
/// from above, with their geometric mean; less if their classes differ. 0 if their heights, sizes or free sides do not
/// agree, or if only one of them has surfaces. Both in one frame.
double likenessOf(const map::Place& a, const map::Place& b);

/// The place in another frame.
map::Place movedPlace(const geometry::Se2& there_from_here, map::Place place);

/// The diagonal [m] of the rectangle around a place, seen from above.
double sizeOf(const map::Place& place);

}  // namespace omnimapper::plugins
