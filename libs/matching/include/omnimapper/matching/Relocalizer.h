#pragma once

#include <mrpt/math/TPose2D.h>
#include <omnimapper/grid/HitMissGrid.h>
#include <omnimapper/matching/BeamFit.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/matching/ScanMatcher.h>

#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace omnimapper::matching {

struct RelocalizerOptions {
  double cell = 0.1;                ///< [m] cell of the grid that is searched
  double sigma = 0.15;              ///< [m] standard deviation of the bell around each map point
  double spacing = 0.1;             ///< [m] smallest distance between the points of a scan that the search uses
  double min_score = 0.4;           ///< smallest mean likelihood of a candidate's points
  double min_share_of_best = 0.85;  ///< smallest share of the best candidate's score
  int max_candidates = 16;
  std::size_t max_blocks = std::numeric_limits<std::size_t>::max();  ///< limit of the search, as in SearchOptions
  /// If the mean log-likelihood of the best candidate's beams is below this, that candidate explains the scan poorly,
  /// for example because something blocks the view. The search is then repeated for twice as many candidates, with
  /// min_share_if_poor in place of min_share_of_best.
  double poor = -0.4;
  double min_share_if_poor = 0.65;
  int reference_scans = 16;     ///< number of map scans around a candidate with which it is matched
  double same_distance = 0.25;  ///< [m] and same_angle: of refined candidates this near only the best is kept
  double same_angle = 0.1;      ///< [rad]
  double place_distance = 0.5;  ///< [m] and place_angle: the probabilities of candidates this near add up
  double place_angle = 0.2;     ///< [rad]
  grid::BeamModel beams;
  int most_beams = 180;          ///< largest number of beams that count as independent
  double lead_sigmas = 0.25;     ///< number of standard errors by which a lead over another candidate is reduced
  double nowhere = -0.9;         ///< mean log-likelihood of the beams at a place that is not in the map
  double min_confidence = 0.95;  ///< smallest probability of an answer
};

/// A scan of the map with the pose of its sensor.
struct MapScan {
  mrpt::math::TPose2D map_from_sensor;
  grid::BeamScan scan;
};

/// One of several scans taken close to each other, in a common frame, for instance that of one of the sensor poses.
struct LocalScan {
  mrpt::math::TPose2D local_from_sensor;
  grid::BeamScan scan;
};

struct LocationCandidate {
  mrpt::math::TPose2D map_from_sensor;  ///< for several scans: map_from_local
  double score = 0;                     ///< of the search: mean likelihood of the points, [0, 1]
  double log_likelihood = 0;            ///< mean of `beams`, free space included
  std::vector<double> beams;            ///< HitMissGrid::logLikelihoods; empty if another candidate is much better
  double probability = 0;               ///< among the candidates and "nowhere in the map"
  ScanMatch match;                      ///< match with the map around it, in the map's frame
};

struct Location {
  enum class Answer {
    found,      ///< the first candidate is the place
    ambiguous,  ///< several are possible, and none is likely enough
    none        ///< the scan fits nowhere
  };
  Answer answer = Answer::none;
  std::vector<LocationCandidate> candidates;  ///< the most probable first
};

/// Finds where in a whole map a scan, or several scans on a short path, were taken. A correlative search finds the
/// places that the points fit; these are refined by a scan matcher and compared by the likelihood of each beam, free
/// space included (HitMissGrid). Probabilities follow from Bayes' rule, with all candidates and "nowhere in the map"
/// equally likely a priori. The lead of the best candidate over another one is the mean difference of their beams'
/// log-likelihoods; it is reduced if the beams disagree about it. Immutable, so threads may share it.
class Relocalizer {
 public:
  /// Throws Error(out_of_range) for a map too large for the grids (BeamModel::max_cells).
  Relocalizer(std::vector<MapScan> map, std::shared_ptr<const ScanMatcher> matcher,
              const RelocalizerOptions& options = {});

  /// Searches the whole map, or the window if it is given. Points that are not finite are left out.
  Location locate(const grid::BeamScan& scan, const std::optional<SearchWindow>& window = std::nullopt) const;
  /// As locate(), but for several scans: places that look alike from one position seldom look alike along a path.
  Location locateTogether(std::vector<LocalScan> scans, const std::optional<SearchWindow>& window = std::nullopt) const;
  /// How the beams of a scan fit the map with its sensor at a pose or near it, as bestFit().
  BeamFit fitAround(const grid::BeamScan& scan, const mrpt::math::TPose2D& map_from_sensor, double distance,
                    double angle) const {
    return bestFit(*beams_, scan, map_from_sensor, distance, angle);
  }

 private:
  struct Query {
    std::vector<LocalScan> scans;
    ScanWithNormals lines;                // in the local frame
    std::vector<Eigen::Vector2f> sought;  // points that the search uses
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
