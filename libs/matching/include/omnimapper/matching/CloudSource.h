#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/MatchCloud.h>
#include <omnimapper/perception/ColourImage.h>
#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/perception/DepthNoise.h>
#include <omnimapper/perception/EdgeDetector.h>

namespace omnimapper::matching {

/// Which points of a depth image and its picture stand for it (thesis 5.4.2).
enum class CloudSource {
  occluding_edges,       ///< pixels before a jump in depth
  rgb_edges,             ///< edges of the picture
  high_curvature_edges,  ///< where a surface turns
  voxels,                ///< the mean point of each cube of a grid
  all_points,            ///< every pixel
};

struct CloudSourceOptions {
  CloudSource source = CloudSource::rgb_edges;
  double voxel = 0.02;                            ///< [m] side of the cubes
  double max_depth = 5;                           ///< [m] what is farther is too noisy
  double pixel_noise = 1;                         ///< [px] across the rays
  perception::DepthNoise noise;                   ///< along them
  double slide = 0.03;                            ///< [m] by which points on surfaces may lie elsewhere on them
  double edge_slide = 3;                          ///< the same along edges, in spreads of the pixels around
  perception::EdgeOptions edges = easilyFound();  ///< which kinds are sought is said by `source`

  /// Edges that are found again in most images rather than those that are surely some.
  static perception::EdgeOptions easilyFound();

  static const base::OptionTable<CloudSourceOptions>& table();
};

/// The points of a depth image that `options` name, in its optical frame, with covariances; with normals, where a
/// surface has one, if they are points of surfaces. `colour`: the picture of the same view, or null. Throws
/// Error(unreadable_input) for edges of a picture where there is none.
CloudPoints cloudOf(const perception::DepthImage& depth, const perception::ColourImage* colour,
                    const CloudSourceOptions& options);

}  // namespace omnimapper::matching
