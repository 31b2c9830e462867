#pragma once

#include <omnimapper/sim_world/Body.h>

#include <cstdint>
#include <string>

namespace omnimapper::sim {

/// Kinds of flat items that hang on walls and are no door signs.
enum class PosterKind {
  poster,        ///< a picture of shapes with a title
  notice,        ///< a sheet of text, which is most like a door sign
  extinguisher,  ///< the red plate above a fire extinguisher
  clock,         ///< a dial with numbers, on a square plate
  announcement   ///< a sheet with a date, a time and the number of another room than the one where it hangs
};

struct PosterSpec {
  std::string name;  ///< of its body and surface
  PosterKind kind = PosterKind::poster;
  std::uint64_t seed = 0;        ///< determines pictures, text and, where it is not given, the size
  double width = 0, height = 0;  ///< [m]; 0: as usual for its kind
  std::string font_file;         ///< empty: DejaVu's
  /// Frame as Sign's: x to the reader's right, y up, z to the reader; origin in the middle of the front, the back
  /// 4 mm behind it.
  geometry::Se3 map_from_poster;
};

constexpr double kPosterThickness = 0.004;  ///< [m]

/// Surface "<name>" is the front, a planar face of kind poster; "<name>/edge" is the rest. Throws std::invalid_argument
/// for a negative size, and what drawText() throws for fonts.
Body makePoster(const PosterSpec& spec);

}  // namespace omnimapper::sim
