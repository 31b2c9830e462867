#pragma once

#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/Views.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::eval {

/// Thresholds for the comparison of a map's surfaces with single views. `same` decides which surfaces lie on each
/// other, as in the comparison with true surfaces.
struct ViewAgreementOptions {
  MapQualityOptions
      same;  ///< max_turn, max_distance, overlap_share, cell; min_area of a surface that is split or level
  double min_plane = 0.05;    ///< [m^2] smallest plane of an image that is used
  double piece_share = 0.02;  ///< smallest share of a level surface that counts as a piece
};

/// Two drawn surfaces of the map that lie on one surface.
struct SplitSurface {
  std::pair<std::size_t, std::size_t> surfaces;  ///< indices in the map's set
  std::string view, other_view;  ///< views that show it as one surface; the second is empty if only one view does
};

/// One surface of the place as all views together show it, on the plane of the view that shows most of it.
struct MergedSurface {
  surfaces::Surface surface;      ///< its plane; `seen`: the cells that any view shows
  surfaces::CellGrid seen_twice;  ///< cells that two planes of views show
  surfaces::CellGrid missing;     ///< cells of seen_twice that no drawn surface of the map covers
  std::vector<std::pair<std::size_t, std::size_t>> planes;  ///< view and plane in it
};

/// The pieces that a level surface, such as a desk or the floor, is split into.
struct LevelPieces {
  std::size_t merged_surface = 0;     ///< index in ViewAgreement::seen
  double area = 0;                    ///< [m^2] its seen area
  double height = 0;                  ///< [m] height of its middle, in the frame of the views
  std::vector<std::size_t> of_map;    ///< drawn surfaces that cover a share of it, largest share first
  std::vector<std::size_t> in_views;  ///< for each view that shows it, its number of planes there; largest number first
};

/// How far the surfaces of a map agree with single images, for places whose true surfaces are not known.
struct ViewAgreement {
  std::size_t views = 0, planes = 0, drawn = 0;
  std::vector<SplitSurface> split;         ///< pairs in the map that two views show as one surface
  std::vector<SplitSurface> split_of_one;  ///< pairs in the map that only one view shows as one surface
  std::vector<std::pair<std::size_t, std::size_t>> doubles;  ///< drawn surfaces that lie on each other, by area alone
  std::vector<MergedSurface> seen;                           ///< the largest first
  AreaCoverage area, area_twice;                             ///< area in any view, and in two views
  std::vector<LevelPieces> levels;                           ///< of level surfaces over min_area, the largest first
  Statistics distance;     ///< [m] of points on planes from the nearest drawn surface there
  double distance_95 = 0;  ///< [m]
  std::size_t points = 0;  ///< number of all points; `distance` is of those within max_distance of a drawn surface
};

/// The map is in the frame of the views. Throws base::Error(unreadable_input) for a surface that reaches too far to be
/// counted in cells. Views without planes, and none at all, agree with any map.
ViewAgreement judgeByViews(const surfaces::SurfaceSet& map, const std::vector<View>& views,
                           const ViewAgreementOptions& options = {});

/// A table of text for a terminal.
std::string table(const ViewAgreement& agreement);
/// The same numbers, and each error of the map, as a JSON object.
std::string json(const ViewAgreement& agreement, const surfaces::SurfaceSet& map);
/// Writes numbers.json and plan.svg (the map from above with errors in colour) into a folder, which is made if missing.
void saveReport(const std::string& folder, const std::string& title, const ViewAgreement& agreement,
                const surfaces::SurfaceSet& map);

}  // namespace omnimapper::eval
