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
  double min_score = 0.3;          ///< poses below it are not looked for; the higher, the faster
  double min_share_of_best = 0.8;  ///< nor are those below this share of the best one's score
  int max_results = 3;
  /// Blocks of poses that are divided before the search ends with what it has found; so many take about 10 us each.
  std::size_t max_blocks = std::numeric_limits<std::size_t>::max();
  /// A result lies further than the distance [m], or is turned by more than the angle [rad], from each better one.
  double min_distance = 0.5;
  double min_angle = 0.35;
};

struct SearchResult {
  mrpt::math::TPose2D map_from_scan;
  double score = 0;      ///< mean likelihood of the scan's points, [0, 1]
  std::size_t area = 0;  ///< index of the area it was found in
};

/// One map of a search in several.
struct SearchArea {
  const grid::LikelihoodPyramid* map;
  SearchWindow window;
};

/// Where a scan fits best, by rising rank: the best pose of all areas, then the best of those distinct from it, and so
/// on. Exact over a lattice that contains each window's centre: steps of a cell in x and y, and of the turn that moves
/// the scan's points by a cell (root mean square range). Poses in different areas are always distinct. A branch and
/// bound, best first, over x, y and yaw together (Olson 2009; Hess et al. 2016), where each point of the scan has a
/// bound as wide as its own sweep. Points that are not finite are left out. Throws Error(out_of_range) if a window is
/// negative or not finite.
std::vector<SearchResult> search(const std::vector<SearchArea>& areas, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchOptions& options = {});
std::vector<SearchResult> search(const grid::LikelihoodPyramid& map, const std::vector<Eigen::Vector2f>& scan_points,
                                 const SearchWindow& window, const SearchOptions& options = {});

/// Yaw between neighbours in the lattice [rad], for these points and this cell [m].
double yawStep(const std::vector<Eigen::Vector2f>& scan_points, double cell);

/// Every point that is at least `spacing` [m] from the one kept before it: near walls no longer outweigh far ones.
std::vector<Eigen::Vector2f> thinned(const std::vector<Eigen::Vector2f>& points, double spacing);

}  // namespace omnimapper::matching
