#pragma once

#include <optional>
#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// What people call a flat surface of a building or of what stands in it.
enum class SurfaceClass {
  floor,
  ceiling,
  wall,
  door,        ///< a face of a leaf
  door_frame,  ///< the sides of the hole that a door or a passage goes through
  window,      ///< pane, sill and frame
  table,       ///< the top
  counter,     ///< the worktop
  shelf,       ///< a board
  cabinet,     ///< any face of a cabinet, and the side of a counter, a desk or a shelf
  seat,        ///< of chairs and sofas, with their arms and backs
  bed,
  appliance,  ///< stove, fridge, printer, bathtub, television, machine, radiator
  ramp,       ///< a floor that is not level
  poster,     ///< what hangs flat on a wall: posters, signs, markers
  object,     ///< things that people carry, boxes that pile up, plants, people
  surface,    ///< nobody can tell
};

/// "door frame" for door_frame; of all others the name as above.
std::string toString(SurfaceClass surface_class);
/// None for an unknown name.
std::optional<SurfaceClass> surfaceClassNamed(const std::string& name);
const std::vector<SurfaceClass>& allSurfaceClasses();

}  // namespace omnimapper::surfaces
