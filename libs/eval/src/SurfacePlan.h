#pragma once

#include <omnimapper/draw/Svg.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::eval {

/// A drawing of surfaces as seen from above: of an upright one the line that it stands on, of another its outlines.
class SurfacePlan {
 public:
  /// It is large enough for all surfaces of the sets.
  SurfacePlan(std::ostream& out, const std::string& title, const std::vector<const surfaces::SurfaceSet*>& sets);

  /// Says what a colour means, to the right of what was said before; `width` [px] is what the text takes.
  void addLegend(const std::string& colour, const std::string& text, double width);
  void draw(const surfaces::Surface& surface, const std::string& colour, double pen);
  /// The cells that are set.
  void draw(const surfaces::CellGrid& cells, const std::string& colour);

 private:
  draw::Svg svg_;
  draw::Axes axes_;
  double legend_x_ = 60;  // [px] where the next entry begins
};

}  // namespace omnimapper::eval
