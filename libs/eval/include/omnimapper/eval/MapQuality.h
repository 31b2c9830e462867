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

/// What counts as the same when the surfaces of a map are held against the true ones. Chosen by what a person would
/// call the same wall, not on a log; doc/results/map_quality.md shows them halved and doubled.
struct MapQualityOptions {
  double cell = 0.05;           ///< [m] areas are counted in cells of this size
  double max_turn = 0.35;       ///< [rad] between normals, with their signs
  double max_distance = 0.1;    ///< [m] of a part of the map's surface from the true plane
  double min_area = 0.3;        ///< [m^2] a true surface must be found if it is so large ...
  double min_seen = 0.5;        ///< ... and this share of it was seen
  double found_share = 0.5;     ///< a true surface is found by one that covers so much of what was seen of it
  double second_share = 0.1;    ///< and by a second one that covers so much
  double overlap_share = 0.2;   ///< two surfaces are a double if they share so much of the smaller one
  double spurious_share = 0.5;  ///< a surface is spurious if less of it lies on true surfaces
};

/// One surface of the map.
struct JudgedSurface {
  std::size_t index = 0;     ///< in the map's set
  double area = 0;           ///< [m^2]
  double share_on_true = 0;  ///< of its area, on any true surface
  bool is_spurious = false;
  /// Of the true surfaces that it lies on, the class and the index of the one with most of its area. None: on none.
  std::optional<surfaces::SurfaceClass> true_class;
  std::optional<std::size_t> true_surface;
  /// Intersection over union of its outline with what was seen of the true surfaces that it stands for; none if it is
  /// spurious.
  std::optional<double> overlap;
};

/// One true surface that is large enough and was seen.
struct SoughtSurface {
  std::size_t index = 0;        ///< in the true set
  double covered = 0;           ///< share of what was seen of it that the drawn surfaces cover together
  std::vector<std::size_t> by;  ///< indices of the map's surfaces that cover second_share of it, most first
  bool is_found = false;        ///< one of them covers found_share
  bool isOnce() const { return is_found && by.size() == 1; }
};

struct SeenArea {
  double seen = 0, covered = 0;  ///< [m^2]
};

/// How the surfaces of a map compare with the true ones.
struct MapQuality {
  std::vector<JudgedSurface> drawn;
  std::vector<JudgedSurface> candidates;  ///< surfaces that the map keeps and does not draw
  std::vector<SoughtSurface> sought;
  std::vector<std::pair<std::size_t, std::size_t>> doubles;  ///< indices of the map's surfaces, each pair once
  std::map<surfaces::SurfaceClass, SeenArea> area;           ///< by true class, of surfaces that never moved
  /// Drawn surfaces that are not spurious, by the class that the map tells, then the true one.
  std::map<surfaces::SurfaceClass, std::map<surfaces::SurfaceClass, std::size_t>> labels;

  std::size_t trueCandidates() const;  ///< not spurious
  std::size_t foundOnce() const;
  std::size_t found() const;
  std::size_t spurious() const;
  /// Of the drawn surfaces that are not spurious, those whose class is right; and of those called so, of all drawn.
  std::size_t rightLabels() const;
  std::pair<std::size_t, std::size_t> rightOf(surfaces::SurfaceClass said) const;  ///< right, all
  double medianOverlap() const;  ///< 0 if nothing is drawn on a true surface
};

/// Compares by area on the true planes. A true surface without `seen` counts as seen all over; where no surface of a
/// class was seen it has no entry in `area`. Posters lie on their wall: what covers one is on that wall, and none need
/// be found. What is moved is never sought, but what lies on it is not spurious. Throws base::Error(unreadable_input)
/// for a surface that reaches too far to be counted in cells.
MapQuality judgeMap(const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth,
                    const MapQualityOptions& options = {});

/// Each surface of the map that lies on a true one, with what that is: what classify() may learn from. The map
/// is in the frame of the truth, whose floor is at z = 0.
std::vector<surfaces::Example> examplesOf(const MapQuality& quality, const surfaces::SurfaceSet& map);

/// A table of text for a terminal.
std::string table(const MapQuality& quality);
/// The same numbers and each surface, as a JSON object.
std::string json(const MapQuality& quality, const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth);
/// Writes numbers.json, plan.svg, the place from above with what is wrong in colour, and examples.csv, what
/// examplesOf() tells, into a folder, made if missing.
void saveReport(const std::string& folder, const std::string& title, const MapQuality& quality,
                const surfaces::SurfaceSet& map, const surfaces::SurfaceSet& truth);

}  // namespace omnimapper::eval
