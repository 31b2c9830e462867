#pragma once

#include <omnimapper/perception/ClusterComparator.h>
#include <omnimapper/perception/Normals.h>

#include <cstdint>
#include <vector>

namespace omnimapper::perception::objects {

/// Finds parts of the clusters of `near` that have no concave edges between them. Objects that touch meet at a concave
/// edge, while most objects have none of their own. Source of the idea: S. Stein et al., Object partitioning using
/// local convexity, CVPR 2014; here the evidence of all pixels along the border of two parts is added up, so that a gap
/// in a concave edge does not join them and a short concave stretch does not cut them.
/// `concave_angle` [rad]: angle between the faces at a concave border that speaks neither for one part nor for two.
/// Returns for each pixel, row by row, the number of its part from 1 on, or 0 for pixels of none. Parts of fewer than
/// `fewest` pixels fall to their neighbours.
std::vector<std::int32_t> convexParts(const ClusterComparator& near, const NormalImage& normals, double concave_angle,
                                      int fewest);

}  // namespace omnimapper::perception::objects
