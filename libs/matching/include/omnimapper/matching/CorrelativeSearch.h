#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/LikelihoodPyramid.h>

#include <Eigen/Core>
#include <limits>
#include <vector>

namespace omnimapper::matching {

/// Poses around a centre, in the map's frame.
struct SearchWindow {
  mrpt::math::TPose2D centre;
  double half_x = 0, half_y = 0;  ///< [m] along the map's axes
  double half_yaw = 0;            ///< [rad]; pi or more: every heading

  /// Every pose at which the sensor stands within `margin` [m] of the map's box.
  static SearchWindow everywhere(const grid::LikelihoodPyramid& map, double margin);
};

struct SearchOptions {
  double min_score = 0.3;          ///< poses with a lower score are not searched; a higher value is faster
  double min_share_of_best = 0.8;  ///< poses with a lower share of the best score are not searched either
  int max_results = 3;
  /// Number of divided blocks of poses after which the search ends with the results found so far; a block takes about
  /// 10 us.
  std::size_t max_blocks = std::numeric_limits<std::size_t>::max();
  /// Results are distinct: compared with every better result, each is farther away than min_distance [m] or rotated by
  /// more than min_angle [rad].
  double min_distance = 0.5;
  double min_angle = 0.35;
};

struct SearchResult {
  mrpt::math::TPose2D map_from_scan;
  double score = 0;      ///< mean likelihood of the scan's points, [0, 1]
  std::size_t area = 0;  ///< index of the area in which it was found
};

/// One of the maps of a search in several maps.
struct SearchArea {
  const grid::LikelihoodPyramid* map;
  SearchWindow window;
};

/// Searches the poses where a scan fits best: first the best pose of all areas, then the best of those that are
/// distinct from it, and so on. Poses in different areas are always distinct. The result is exact on a lattice of poses
/// that contains each window's centre. The steps of the lattice are one cell in x and y and, in yaw, the rotation that
/// moves a point at the root mean square range of the scan's points by one cell. The method is best-first branch and
/// bound over x, y and yaw together (Olson 2009; Hess et al. 2016), where the bound of each point covers just the cells
/// that this point sweeps. Points that are not finite are left out. Throws Error(out_of_range) if a window is negative
/// or not finite.
std::vector<SearchResult> search(const std::vector<SearchArea>& areas, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchOptions& options = {});
std::vector<SearchResult> search(const grid::LikelihoodPyramid& map, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchWindow& window, const SearchOptions& options = {});

/// Yaw step of the lattice [rad] for these points and cells of this size [m].
double yawStep(const std::vector<Eigen::Vector2f>& scan_points, double cell);

/// Keeps each point that is at least `spacing` [m] from the point kept before it, so that near walls do not outweigh
/// far walls.
std::vector<Eigen::Vector2f> thinned(const std::vector<Eigen::Vector2f>& points, double spacing);

}  // namespace omnimapper::matching
