#pragma once

#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/Views.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::eval {

/// Thresholds for the comparison of a map's surfaces with single views.
struct ViewAgreementOptions {
  /// Decides which surfaces lie on each other, as in the comparison with true surfaces. Only these members are used:
  /// max_turn, max_distance, overlap_share, cell, and min_area, the smallest area of a surface that counts as split or
  /// as level.
  MapQualityOptions same;
  double min_plane = 0.05;    ///< [m^2] area of the smallest plane of an image that is used
  double piece_share = 0.02;  ///< a drawn surface that covers at least this share of a level surface counts as a piece
};

/// Two drawn surfaces of the map that lie on one surface.
struct SplitSurface {
  std::pair<std::size_t, std::size_t> surfaces;  ///< indices in the map's set
  std::string view, other_view;  ///< views that show both as one surface; `other_view` is empty if only one does
};

/// One surface of the place as all views together show it, on the plane of the view that shows most of the surface.
struct MergedSurface {
  surfaces::Surface surface;      ///< the plane; `seen` has the cells that any view shows
  surfaces::CellGrid seen_twice;  ///< cells that at least two planes of views show
  surfaces::CellGrid missing;     ///< cells of seen_twice that no drawn surface of the map covers
  std::vector<std::pair<std::size_t, std::size_t>> planes;  ///< indices of the view and of the plane in that view
};

/// The pieces into which a level surface, such as a desk or the floor, is split.
struct LevelPieces {
  std::size_t merged_surface = 0;     ///< index in ViewAgreement::seen
  double area = 0;                    ///< [m^2] seen area of the surface
  double height = 0;                  ///< [m] height of the surface's middle, in the frame of the views
  std::vector<std::size_t> of_map;    ///< drawn surfaces that are pieces of the surface, the largest first
  std::vector<std::size_t> in_views;  ///< number of pieces in each view that shows the surface, the largest first
};

/// How far the surfaces of a map agree with single images, for places whose true surfaces are not known.
struct ViewAgreement {
  std::size_t views = 0, planes = 0, drawn = 0;
  std::vector<SplitSurface> split;         ///< pairs of drawn surfaces that two views show as one surface
  std::vector<SplitSurface> split_of_one;  ///< pairs of drawn surfaces that only one view shows as one surface
  std::vector<std::pair<std::size_t, std::size_t>> doubles;  ///< drawn surfaces that lie on each other; no view is used
  std::vector<MergedSurface> seen;                           ///< surfaces of the place, the largest first
  AreaCoverage area, area_twice;    ///< for the area that any view shows, and for the area that two planes show
  std::vector<LevelPieces> levels;  ///< of level surfaces of at least min_area, the largest first
  Statistics distance;              ///< [m] of the points on planes from the nearest drawn surface at that place
  double distance_95 = 0;           ///< [m] 95 % of these distances are at most this
  std::size_t points = 0;  ///< number of all points; `distance` counts those within max_distance of a drawn surface
};

/// Compares the map with the views. The map must be in the frame of the views. Throws base::Error(unreadable_input) for
/// a surface that is too large to be counted in cells. If no view has a plane, any map agrees with the views.
ViewAgreement judgeByViews(const surfaces::SurfaceSet& map, const std::vector<View>& views,
                           const ViewAgreementOptions& options = {});

/// A table of text for a terminal.
std::string table(const ViewAgreement& agreement);
/// The same numbers as table(), and each error of the map, as a JSON object.
std::string json(const ViewAgreement& agreement, const surfaces::SurfaceSet& map);
/// Writes numbers.json and plan.svg (the map from above with errors in colour) into a folder, which is created if
/// missing.
void saveReport(const std::string& folder, const std::string& title, const ViewAgreement& agreement,
                const surfaces::SurfaceSet& map);

}  // namespace omnimapper::eval
