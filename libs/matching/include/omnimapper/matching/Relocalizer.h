#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/HitMissGrid.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/matching/ScanMatcher.h>

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::matching {

struct RelocalizerOptions {
  double cell = 0.1;                ///< [m] of the grid that is searched
  double sigma = 0.15;              ///< [m] of its bell
  double spacing = 0.1;             ///< [m] between the points of the scan that are searched with
  double min_score = 0.4;           ///< of a candidate: mean likelihood of its points
  double min_share_of_best = 0.85;  ///< of a candidate's score
  int max_candidates = 16;
  std::size_t max_blocks = std::numeric_limits<std::size_t>::max();  ///< of the search, as in SearchOptions
  /// Mean logarithm of the beams' likelihoods below which the best candidate explains the scan poorly: something
  /// stands in the way. The search then goes on down to the second share, for twice as many.
  double poor = -0.4;
  double min_share_if_poor = 0.65;
  int reference_scans = 16;     ///< of the map, nearest to a candidate, that it is refined against
  double same_distance = 0.25;  ///< [m] and
  double same_angle = 0.1;      ///< [rad] within which two refined candidates are one
  double place_distance = 0.5;  ///< [m] and
  double place_angle = 0.2;     ///< [rad] within which candidates do not speak against each other
  grid::BeamModel beams;
  int most_beams = 180;          ///< that count as independent of each other
  double doubt = 0.25;           ///< standard errors by which a lead over another candidate counts less
  double nowhere = -0.9;         ///< mean logarithm of the beams' likelihoods of a place that is not in the map
  double min_confidence = 0.95;  ///< of an answer
};

/// A scan of the map, where its sensor stood.
struct MapScan {
  mrpt::math::TPose2D map_from_sensor;
  grid::BeamScan scan;
};

/// What was seen from several places close to each other, in a frame of its own: one of the sensor poses, say.
struct LocalScan {
  mrpt::math::TPose2D local_from_sensor;
  grid::BeamScan scan;
};

struct LocationCandidate {
  mrpt::math::TPose2D map_from_sensor;  ///< of the single scan; map_from_local of several
  double score = 0;                     ///< of the search: mean likelihood of the points, [0, 1]
  double log_likelihood = 0;            ///< of all beams, free space included: the mean of `beams`
  std::vector<double> beams;            ///< HitMissGrid::logLikelihoods; empty if others are much better
  double probability = 0;               ///< among the candidates and "nowhere in the map"
  ScanMatch match;                      ///< with the map around it; its reference is the map
};

struct Location {
  enum class Answer {
    found,      ///< the first candidate
    ambiguous,  ///< it may be one of several, and none is likely enough
    none        ///< the scan fits nowhere
  };
  Answer answer = Answer::none;
  std::vector<LocationCandidate> candidates;  ///< the most probable first
};

/// Finds where in a whole map a single scan was taken, or several on a short way: a correlative search for the places
/// that its points fit, refined by the fine matcher, and judged by what each beam says of free space and walls
/// (HitMissGrid). Probabilities are those of Bayes, all candidates and "nowhere in the map" being equally likely
/// before; but a lead that some beams give and others take away counts for less than its mean. Never changes, so
/// threads may share it.
class Relocalizer {
 public:
  /// Throws Error(out_of_range) for a map too large for the grids (BeamModel::max_cells).
  Relocalizer(std::vector<MapScan> map, std::shared_ptr<const ScanMatcher> matcher,
              const RelocalizerOptions& options = {});

  /// In the whole map, or in the window if it is given. Points that are not finite are left out.
  Location locate(const grid::BeamScan& scan, const std::optional<SearchWindow>& window = std::nullopt) const;
  /// The same for several scans: what looks alike from one spot seldom does along a way.
  Location locateTogether(std::vector<LocalScan> scans, const std::optional<SearchWindow>& window = std::nullopt) const;

 private:
  struct Query {
    std::vector<LocalScan> scans;
    ScanWithNormals lines;                // in the local frame
    std::vector<Eigen::Vector2f> sought;  // those that are searched with
  };
  Query queryOf(std::vector<LocalScan> scans) const;
  std::vector<double> logLikelihoods(const Query& query, const mrpt::math::TPose2D& map_from_local) const;
  std::vector<LocationCandidate> candidates(const Query& query, const SearchWindow& window, double min_share,
                                            int most) const;
  LocationCandidate refined(const SearchResult& place, const Query& query) const;
  ScanWithNormals around(const mrpt::math::TPose2D& pose) const;
  void settle(LocationCandidate& candidate, const Query& query) const;
  void sortAndMerge(std::vector<LocationCandidate>& candidates) const;
  Location judged(std::vector<LocationCandidate> candidates, const Query& query) const;

  struct Placed {
    mrpt::math::TPose2D map_from_sensor;
    ScanWithNormals lines;
  };
  RelocalizerOptions options_;
  std::shared_ptr<const ScanMatcher> matcher_;
  std::vector<Placed> map_;
  std::unique_ptr<const grid::LikelihoodPyramid> pyramid_;
  std::unique_ptr<const grid::HitMissGrid> beams_;
};

}  // namespace omnimapper::matching
