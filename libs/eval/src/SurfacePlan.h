#pragma once

#include <omnimapper/draw/Svg.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::eval {

/// A drawing of surfaces as seen from above: upright ones as the line that they stand on, others by their outlines.
class SurfacePlan {
 public:
  /// The drawing is large enough for all surfaces of the sets.
  SurfacePlan(std::ostream& out, const std::string& title, const std::vector<const surfaces::SurfaceSet*>& sets);

  /// Adds the meaning of a colour to the legend, to the right of the entries before; `width` [px]: width of the entry.
  void addLegend(const std::string& colour, const std::string& text, double width);
  void draw(const surfaces::Surface& surface, const std::string& colour, double pen);
  /// Draws the cells that are set.
  void draw(const surfaces::CellGrid& cells, const std::string& colour);

 private:
  draw::Svg svg_;
  draw::Axes axes_;
  double legend_x_ = 60;  // [px] where the next entry begins
};

}  // namespace omnimapper::eval
