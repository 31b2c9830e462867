#pragma once

#include <omnimapper/surfaces/Examples.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// What a surface probably is, and why.
struct Judgement {
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< "level, 0.74 m above the floor, 1.60 by 0.80 m: table 0.91, cabinet 0.09"
};

/// What surfaces are by how they lie, how high, how large, how far up they reach, and what stands behind and beside
/// them: those of the known examples that are most alike vote, the more alike the more (k nearest neighbours, weighted
/// by the inverse of the squared distance; Dudani: The distance-weighted k-nearest-neighbor rule, IEEE Transactions on
/// Systems, Man, and Cybernetics 6, 1976). "surface" where none has half of the votes or none is alike. The z of the
/// map is up and `floor` [m] is where people walk.
std::vector<Judgement> classify(const std::vector<Surface>& surfaces, double floor,
                                const std::vector<Example>& examples = knownExamples());

}  // namespace omnimapper::surfaces
