#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/DepthImage.h>
#include <omnimapper/camera/DepthNoise.h>
#include <omnimapper/matching/MatchCloud.h>
#include <omnimapper/perception/EdgeDetector.h>

namespace omnimapper::matching {

/// Which points of a depth image and its picture are registered (thesis 5.4.2).
enum class CloudSource {
  occluding_edges,       ///< pixels on the near side of a depth discontinuity
  rgb_edges,             ///< edges of the picture
  high_curvature_edges,  ///< curvature edges, where surfaces meet at an angle
  voxels,                ///< the mean point of each cube of a grid
  all_points,            ///< every pixel
};

struct CloudSourceOptions {
  CloudSource source = CloudSource::rgb_edges;
  double voxel = 0.02;       ///< [m] side of the cubes
  double max_depth = 5;      ///< [m] points with a larger depth are left out as too noisy
  double pixel_noise = 1;    ///< [px] standard deviation across the rays
  camera::DepthNoise noise;  ///< noise along the rays
  double slide = 0.03;       ///< [m] standard deviation of a point along its surface
  double edge_slide = 3;     ///< that of a point along its edge, as a factor on the spread of the edge pixels
  perception::EdgeOptions edges = easilyFound();  ///< `source` selects which kinds of edges are detected

  /// Options for edges that are detected again in most images, at the price of some false edges.
  static perception::EdgeOptions easilyFound();

  static const base::OptionTable<CloudSourceOptions>& table();
};

/// Extracts the points of a depth image that `options` select, in the camera's optical frame, with covariances. Points
/// of surfaces also get normals, NaN where there is none. `colour`: the picture of the same view, or null. Throws
/// Error(unreadable_input) if edges of a picture are requested and there is no picture.
CloudPoints cloudOf(const camera::DepthImage& depth, const camera::ColourImage* colour,
                    const CloudSourceOptions& options);

}  // namespace omnimapper::matching
