#pragma once

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// Class of a flat surface of a building or of an object in it, as people call it.
enum class SurfaceClass {
  floor,
  ceiling,
  wall,
  door,        ///< a face of a door leaf
  door_frame,  ///< the sides of the opening of a door or a passage
  window,      ///< pane, sill and frame
  table,       ///< a table top
  counter,     ///< a worktop
  shelf,       ///< a board of a shelf
  cabinet,     ///< any face of a cabinet, and the side of a counter, a desk or a shelf
  seat,        ///< seats of chairs and sofas, and their arms and backs
  bed,
  appliance,  ///< stove, fridge, printer, bathtub, television, machine, radiator
  ramp,       ///< a floor that is not level
  poster,     ///< flat items on a wall: posters, signs, markers
  object,     ///< items that people carry, piled boxes, plants, people
  surface,    ///< unknown
};

/// "door frame" for door_frame; for all other classes the name above.
std::string toString(SurfaceClass surface_class);
/// None for an unknown name.
std::optional<SurfaceClass> surfaceClassNamed(const std::string& name);
const std::vector<SurfaceClass>& allSurfaceClasses();

}  // namespace omnimapper::surfaces
