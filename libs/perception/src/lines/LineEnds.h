#pragma once

#include <omnimapper/obs/CObservationLaserLines.h>

#include <vector>

#include "LineFit.h"

namespace omnimapper::perception::lines {

/// Where two neighbours are one after the other or overlap, the points between them go to the line they are nearer to.
void shareOut(const ScanPoints& points, std::vector<Stretch>& stretches, double gate);

/// The ends of a line: where, and why there.
struct Ends {
  geometry::Segment2 segment;
  obs::LineEnd from, to;
};
/// `fits` in the order of their first points; of number `index`.
Ends endsOf(const ScanPoints& points, const std::vector<Fit>& fits, std::size_t index, double gate);

}  // namespace omnimapper::perception::lines
