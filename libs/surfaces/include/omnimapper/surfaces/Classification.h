#pragma once

#include <omnimapper/surfaces/Examples.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <string>
#include <vector>

namespace omnimapper::surfaces {

/// Probable class of a surface, with the reason.
struct Judgement {
  SurfaceClass is = SurfaceClass::surface;
  std::string reason;  ///< "level, 0.74 m above the floor, 1.60 by 0.80 m: table 0.91, cabinet 0.09"
};

/// Classifies surfaces by their orientation, height, size, upper and lower edge, and by the surfaces behind and beside
/// them. The examples most similar to a surface vote on its class (k nearest neighbours, weighted by the inverse of the
/// squared distance; Dudani: The distance-weighted k-nearest-neighbor rule, IEEE Transactions on Systems, Man, and
/// Cybernetics 6, 1976). The class is "surface" if no class has half of the votes or no example is similar. What is
/// around a surface then corrects its class: a door leaf has two faces, furniture has sides, a wall is not narrow. The
/// z of the map is up, and `floor` [m] is the height of the floor.
std::vector<Judgement> classify(const std::vector<Surface>& surfaces, double floor,
                                const std::vector<Example>& examples = knownExamples());

}  // namespace omnimapper::surfaces
