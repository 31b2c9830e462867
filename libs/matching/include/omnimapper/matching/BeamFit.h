#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/HitMissGrid.h>

namespace omnimapper::matching {

/// How the beams of a scan fit a map, free space included.
struct BeamFit {
  /// Largest mean log-likelihood of the beams (grid::HitMissGrid). It is about -1.2 where the map is unknown.
  double log_likelihood = 0;
  /// Smallest share of the beams that end in free space or pass through walls. Beams that end where the map is unknown
  /// do not contradict it.
  double contradicting = 0;
};

/// The fit at poses of the sensor around `map_from_sensor`, up to `distance` [m] and `angle` [rad] away; each of the
/// two numbers is that of the pose where it is best. Of many beams a part is used. All zero without beams.
BeamFit bestFit(const grid::HitMissGrid& map, const grid::BeamScan& beams, const mrpt::math::TPose2D& map_from_sensor,
                double distance, double angle);

}  // namespace omnimapper::matching
