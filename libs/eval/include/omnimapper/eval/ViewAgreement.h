#pragma once

#include <omnimapper/eval/MapQuality.h>
#include <omnimapper/eval/Statistics.h>
#include <omnimapper/eval/Views.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::eval {

/// What counts when the surfaces of a map are held against single views. What lies on what is as for the true surfaces.
struct ViewAgreementOptions {
  MapQualityOptions
      same;  ///< max_turn, max_distance, overlap_share, cell; min_area of a surface that is split or level
  double min_plane = 0.05;    ///< [m^2] a plane of an image must be so large to tell anything
  double piece_share = 0.02;  ///< a piece of a level surface has so much of it
};

/// Two drawn surfaces of the map that lie on one surface.
struct SplitSurface {
  std::pair<std::size_t, std::size_t> surfaces;  ///< indices in the map's set
  std::string view, other_view;  ///< in which it is one; the second is empty if only one view shows it so
};

/// What the views show of one surface of the place, all of them together, on the plane of the one that shows most.
struct SeenSurface {
  surfaces::Surface surface;      ///< plane; `seen`: what any view shows
  surfaces::CellGrid seen_twice;  ///< what two planes of views show
  surfaces::CellGrid missing;     ///< of what was seen twice, what no drawn surface of the map has
  std::vector<std::pair<std::size_t, std::size_t>> planes;  ///< view and plane in it
};

/// Into how much a level surface falls, such as a desk or the floor.
struct LevelPieces {
  std::size_t seen_surface = 0;       ///< index in ViewAgreement::seen
  double area = 0;                    ///< [m^2] that was seen of it
  double height = 0;                  ///< [m] of its middle, in the frame of the views
  std::vector<std::size_t> of_map;    ///< drawn surfaces that have a share of it, most first
  std::vector<std::size_t> in_views;  ///< of each view that shows it, how many planes it makes of it; most first
};

/// How far the surfaces of a map agree with single images where nobody knows the true surfaces.
struct ViewAgreement {
  std::size_t views = 0, planes = 0, drawn = 0;
  std::vector<SplitSurface> split;                           ///< one in two views, two in the map
  std::vector<SplitSurface> split_of_one;                    ///< one in a single view only, two in the map
  std::vector<std::pair<std::size_t, std::size_t>> doubles;  ///< drawn surfaces that lie on each other, by area alone
  std::vector<SeenSurface> seen;                             ///< the largest first
  SeenArea area, area_twice;                                 ///< of planes in any view, and in two views
  std::vector<LevelPieces> levels;                           ///< of level surfaces over min_area, the largest first
  Statistics distance;     ///< [m] of points on planes from the nearest drawn surface there
  double distance_95 = 0;  ///< [m]
  std::size_t points = 0;  ///< all; those of `distance` lie within max_distance of a drawn surface
};

/// The map is in the frame of the views. Throws base::Error(unreadable_input) for a surface that reaches too far to be
/// counted in cells. Views without planes, and none at all, agree with any map.
ViewAgreement judgeByViews(const surfaces::SurfaceSet& map, const std::vector<View>& views,
                           const ViewAgreementOptions& options = {});

/// A table of text for a terminal.
std::string table(const ViewAgreement& agreement);
/// The same numbers, and each fault, as a JSON object.
std::string json(const ViewAgreement& agreement, const surfaces::SurfaceSet& map);
/// Writes numbers.json and plan.svg, the map from above with what is wrong in colour, into a folder, made if missing.
void saveReport(const std::string& folder, const std::string& title, const ViewAgreement& agreement,
                const surfaces::SurfaceSet& map);

}  // namespace omnimapper::eval
