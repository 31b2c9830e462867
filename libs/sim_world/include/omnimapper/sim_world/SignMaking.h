#pragma once

#include <omnimapper/sim_world/World.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// How the signs of a building look.
enum class SignStyle {
  dark,   ///< dark blue plate, white bold sans text in the middle, the first line large, dots like braille below
  white,  ///< white plate with a black border and a rule, serif text on the left, the first line large, an arrow
  exit    ///< green plate with large white capitals and an arrow, as on escape routes
};

/// Height above the floor at which the centres of signs of this style usually are [m].
double usualHeight(SignStyle style);

/// Thickness of every door sign: the frame of a sign is this far in front of the wall on which the sign hangs [m].
constexpr double kSignThickness = 0.006;

struct SignSpec {
  std::string name;                ///< of its body and surface
  std::vector<std::string> lines;  ///< number first, then names, UTF-8
  std::string room;                ///< the room it names
  SignStyle style = SignStyle::dark;
  double width = 0, height = 0;  ///< [m]; 0: as its style and text need
  std::string font_file;         ///< for all its text; empty: the fonts of its style
  geometry::Se3 map_from_sign;   ///< frame as Sign's; the origin is in the middle of the front
};

struct MadeSign {
  Body body;  ///< surface "<name>" is the front, with its text at 2,000 pixels a metre; "<name>/edge" is the rest
  Sign sign;
};

/// A thin plate with text. Capital letters are at least 24 pixels high on the texture. Throws base::Error(out_of_range)
/// if there is no text, or if the text does not fit the given size or, without one, 0.5 m. Also throws what drawText()
/// throws for fonts.
MadeSign makeSign(const SignSpec& spec);

}  // namespace omnimapper::sim
