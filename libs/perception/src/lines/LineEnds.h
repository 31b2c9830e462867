#pragma once

#include <omnimapper/obs/CObservationLaserLines.h>

#include <vector>

#include "LineFit.h"

namespace omnimapper::perception::lines {

/// Moves the seam between neighbouring lines that overlap or follow one another to where the points on both sides fit
/// their lines best.
void shareOut(const ScanPoints& points, std::vector<Stretch>& stretches, double gate);

/// The two ends of a line, and why it ends there.
struct Ends {
  geometry::Segment2 segment;
  obs::LineEnd from, to;
};
/// The ends of line `index`. `fits` are in the order of their first points.
Ends endsOf(const ScanPoints& points, const std::vector<Fit>& fits, std::size_t index, double gate);

}  // namespace omnimapper::perception::lines
