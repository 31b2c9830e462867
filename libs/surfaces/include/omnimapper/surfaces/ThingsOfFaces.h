#pragma once

#include <omnimapper/surfaces/SurfaceSet.h>

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace omnimapper::surfaces {

/// A thing that stands in a room, such as a bed, a table, a sofa or a cabinet, of which some faces are known. It is
/// described by an upright box along its own axes [m].
struct Thing {
  SurfaceClass is = SurfaceClass::surface;
  std::vector<std::size_t> faces;  ///< indices of the surfaces, ascending
  Eigen::Vector2d middle{0, 0};    ///< of the box, as seen from above
  double direction = 0;            ///< of the longer side, from the x axis, in [-pi/2, pi/2) [rad]
  double length = 0, width = 0;    ///< sides of the box; `width` is small if only one side of the thing was seen
  double bottom = 0, top = 0;      ///< z

  /// The corners of the box as seen from above, counter-clockwise.
  std::vector<Eigen::Vector2d> corners() const;
};

/// Whether things have faces of this class: tables, counters, shelves, cabinets, seats, beds and appliances.
bool isOfThing(SurfaceClass surface_class);

/// The thing that has exactly these faces, of which there must be one, all with corners. z is up.
Thing thingOf(const std::vector<Surface>& faces);

/// The things whose faces are among the surfaces, in the order of their first faces; each face is of one thing, which
/// may have no other. Two faces are of one thing if they touch as the faces of one body do: sides that meet at a
/// corner, a top and the sides below its edge, boards of a shelf above each other, the seat and the arms of a sofa,
/// pieces of one face. Their classes must agree; a cabinet may be the side of a table, a counter or a shelf. The class
/// of a thing is that of its largest level face that is no cabinet, or else the one that most of its area has. z is up.
std::vector<Thing> thingsOf(const std::vector<Surface>& surfaces);

}  // namespace omnimapper::surfaces
