#pragma once

#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// What a surface probably is, and why.
struct Judgement {
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< "0.74 m above the floor, 1.60 by 0.80 m: table 0.91, cabinet 0.08"
};

/// What surfaces are by how they lie, how high, how large, how far up they reach, and what stands behind and beside
/// them: the class of the greatest posterior probability, "surface" where none has half of it. The likelihoods are soft
/// windows about usual sizes of rooms and furniture (doc/results/map_quality.md), the z of the map is up and
/// `floor` [m] is where people walk.
std::vector<Judgement> classify(const std::vector<Surface>& surfaces, double floor);

}  // namespace omnimapper::surfaces
