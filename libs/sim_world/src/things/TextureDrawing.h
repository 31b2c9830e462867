#pragma once

#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Texture.h>

#include <Eigen/Core>
#include <vector>

namespace omnimapper::sim {

// Drawing into a Texture. Coordinates are pixels, x to the right and y down, (0, 0) the upper left corner of the
// picture; colours are in [0, 1]. Parts outside the picture are left out; edges are smooth.
using Colour = Eigen::Vector3f;

Texture blankTexture(int width, int height, const Colour& colour);
void setPixel(Texture& texture, int x, int y, const Colour& colour);
Colour pixelOf(const Texture& texture, int x, int y);
/// colour * share + what was there * (1 - share).
void blendPixel(Texture& texture, int x, int y, const Colour& colour, float share);

struct Box2 {
  double left, top, right, bottom;
};
void fillBox(Texture& texture, const Box2& box, const Colour& colour);
/// Draws the four sides of a box, `width` wide, inside it.
void drawFrame(Texture& texture, const Box2& box, double width, const Colour& colour);
void fillDisc(Texture& texture, double x, double y, double radius, const Colour& colour);
void drawRing(Texture& texture, double x, double y, double radius, double width, const Colour& colour);
void drawLine(Texture& texture, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
              const Colour& colour);
/// Fills a convex polygon.
void fillPolygon(Texture& texture, const std::vector<Eigen::Vector2d>& corners, const Colour& colour);

/// Colour of a hue, saturation and value, all in [0, 1].
Colour colourOf(double hue, double saturation, double value);
Colour randomColour(Random& random, double saturation_low, double saturation_high, double value_low, double value_high);

/// Smooth noise over the unit square that is periodic beyond its edges; each octave has half the amplitude and twice
/// the cells of the one before.
class PeriodicNoise {
 public:
  PeriodicNoise(Random& random, int cells_across, int cells_up, int octaves);
  /// About in [-1, 1]; u and v repeat beyond [0, 1].
  float at(double u, double v) const;

 private:
  struct Octave {
    int columns, rows;
    std::vector<float> values;
  };
  std::vector<Octave> octaves_;
};

}  // namespace omnimapper::sim
