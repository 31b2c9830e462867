#pragma once

#include <omnimapper/surfaces/Examples.h>
#include <omnimapper/surfaces/SurfaceSet.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::eval {

/// Thresholds for the comparison of a map's surfaces with the true ones. They were chosen so that surfaces count as the
/// same where a person would call them the same wall, and were not tuned on a log. doc/results/map_quality.md has
/// results with half and twice their values.
struct MapQualityOptions {
  double cell = 0.05;          ///< [m] side of the cells in which areas are counted
  double max_turn = 0.35;      ///< [rad] largest angle between normals, with their signs
  double max_distance = 0.1;   ///< [m] largest distance of a part of the map's surface from the true plane
  double min_area = 0.3;       ///< [m^2] a true surface should be found if it is at least this large ...
  double min_seen = 0.5;       ///< ... and at least this share of it was seen
  double found_share = 0.5;    ///< a true surface is found if one surface of the map covers this share of its seen part
  double second_share = 0.1;   ///< a further surface of the map that covers this share counts as a second one
  double overlap_share = 0.2;  ///< two surfaces of the map are a double if they share this part of the smaller one
  double spurious_share = 0.5;  ///< a surface of the map is spurious if less than this share lies on true surfaces
};

/// Judgement of one surface of the map.
struct JudgedSurface {
  std::size_t index = 0;     ///< index in the map's set
  double area = 0;           ///< [m^2]
  double share_on_true = 0;  ///< share of the area that lies on any true surface
  bool is_spurious = false;
  /// The class of the true surfaces on which most of this surface's area lies (a poster counts as a wall), and the
  /// index of the true surface on which the largest part of it lies. None if no part lies on a true surface.
  std::optional<surfaces::SurfaceClass> true_class;
  std::optional<std::size_t> true_surface;
  /// Intersection over union of this surface's outline with the seen parts of the true surfaces that this surface
  /// represents; none if this surface is spurious.
  std::optional<double> overlap;
};

/// Judgement of one true surface that is large enough and was seen.
struct SoughtSurface {
  std::size_t index = 0;        ///< index in the true set
  double covered = 0;           ///< share of the seen part that all drawn surfaces cover together
  std::vector<std::size_t> by;  ///< indices of drawn surfaces that each cover second_share, largest share first
  bool is_found = false;        ///< whether a drawn surface covers found_share
  bool isOnce() const { return is_found && by.size() == 1; }
};

struct AreaCoverage {
  double seen = 0, covered = 0;  ///< [m^2]
};

/// How the surfaces of a map compare with the true ones.
struct MapQuality {
  std::vector<JudgedSurface> drawn;
  std::vector<JudgedSurface> candidates;  ///< surfaces that the map keeps and does not draw
  std::vector<SoughtSurface> sought;
  std::vector<std::pair<std::size_t, std::size_t>> doubles;  ///< pairs of indices of the map's surfaces, each pair once
  std::map<surfaces::SurfaceClass, AreaCoverage> area;       ///< by true class; surfaces that were moved do not count
  /// Number of drawn surfaces that are not spurious, by the class in the map and the true class.
  std::map<surfaces::SurfaceClass, std::map<surfaces::SurfaceClass, std::size_t>> labels;

  std::size_t trueCandidates() const;  ///< candidates that are not spurious
  std::size_t foundOnce() const;
  std::size_t found() const;
  std::size_t spurious() const;
  /// Number of drawn surfaces that are not spurious and have the right class.
  std::size_t rightLabels() const;
  /// Of the drawn surfaces that are not spurious and have the class `said` in the map: the number of those that have
  /// the right class, and the number of all.
  std::pair<std::size_t, std::size_t> rightOf(surfaces::SurfaceClass said) const;
  double medianOverlap() const;  ///< 0 if all drawn surfaces are spurious
};

/// Compares the surfaces by their areas on the true planes. A true surface without `seen` counts as seen as a whole. A
/// class of which no surface was seen has no entry in `area`. A poster counts as part of its wall and need not be
/// found. A surface that was moved need not be found either, but surfaces of the map on it are not spurious. Throws
/// base::Error(unreadable_input) for a surface that is too large to be counted in cells.
MapQuality judgeMap(const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth,
                    const MapQualityOptions& options = {});

/// The surfaces of the map of which at least 60 % lie on true surfaces, with their true classes, as examples for
/// classify(). The map must be in the frame of the truth, whose floor is at z = 0.
std::vector<surfaces::Example> examplesOf(const MapQuality& quality, const surfaces::SurfaceSet& map);

/// A table of text for a terminal.
std::string table(const MapQuality& quality);
/// The same numbers as table(), and each surface, as a JSON object.
std::string json(const MapQuality& quality, const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth);
/// Writes into a folder, which is created if missing: numbers.json, plan.svg (the place from above with errors in
/// colour) and examples.csv (the result of examplesOf()).
void saveReport(const std::string& folder, const std::string& title, const MapQuality& quality,
                const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth);

}  // namespace omnimapper::eval
