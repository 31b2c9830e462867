#include <omnimapper/matching/Relocaliser.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMetresPerRadian = 2;  // how far away a scan of the map counts that looks another way
constexpr double kSpread = 0.05;  // of mean logarithms of likelihoods over a cell of the grid that they are read from

double turn(const TPose2D& a, const TPose2D& b) {
  return std::abs(std::remainder(a.phi - b.phi, 2 * kPi));
}
double distance(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

Relocaliser::Relocaliser(std::vector<MapScan> map, std::shared_ptr<const ScanMatcher> matcher,
                         const RelocaliserOptions& options)
    : options_(options), matcher_(std::move(matcher)) {
  PlanarScan all;
  std::vector<BeamGrid::Placed> placed;
  for (MapScan& scan : map) {
    scan.scan = finitePart(std::move(scan.scan));
    placed.push_back({scan.map_from_sensor, &scan.scan});
    map_.push_back({scan.map_from_sensor, fitLines(scan.scan.hits)});
    append(map_.back().lines, scan.map_from_sensor, all);
  }
  LikelihoodOptions grid;
  grid.cell = options.cell;
  grid.sigma = options.sigma;
  grid.max_cells = options.beams.max_cells;
  pyramid_ = std::make_unique<const LikelihoodPyramid>(all.points, grid);
  beams_ = std::make_unique<const BeamGrid>(placed, options.beams);
}

Location Relocaliser::locate(const BeamScan& all_beams, const std::optional<SearchWindow>& window) const {
  const BeamScan scan = finitePart(all_beams);
  SearchOptions search_options;
  search_options.min_score = options_.min_score;
  search_options.min_share_of_best = options_.min_share_of_best;
  search_options.max_results = options_.max_candidates;
  const PlanarScan lines = fitLines(scan.hits);
  const auto places = search(*pyramid_, thinned(lines.points, options_.spacing),
                             window ? *window : SearchWindow::everywhere(*pyramid_, 0), search_options);
  Location location;
  for (const SearchResult& place : places) {
    LocationCandidate candidate;
    candidate.map_from_sensor = place.map_from_scan;
    candidate.score = place.score;
    refine(lines, scan, candidate);
    location.candidates.push_back(candidate);
  }
  weigh(scan, location);
  return location;
}

// Against the scans of the map that were taken nearest to it. Where the beams speak against the result, the candidate
// stays where it is.
void Relocaliser::refine(const PlanarScan& lines, const BeamScan& scan, LocationCandidate& candidate) const {
  const TPose2D& pose = candidate.map_from_sensor;
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < map_.size(); ++i) {
    const TPose2D& other = map_[i].map_from_sensor;
    nearest.emplace_back(distance(pose, other) + kMetresPerRadian * turn(pose, other), i);
  }
  const auto count = std::min<std::size_t>(nearest.size(), options_.reference_scans);
  std::partial_sort(nearest.begin(), nearest.begin() + count, nearest.end());
  PlanarScan around;
  for (std::size_t k = 0; k < count; ++k) {
    const Placed& near = map_[nearest[k].second];
    append(near.lines, near.map_from_sensor, around);
  }
  candidate.log_likelihood = beams_->logLikelihood(scan, pose);
  candidate.match = matcher_->match(*matcher_->prepare(std::move(around)), lines, {pose});
  const double refined = beams_->logLikelihood(scan, candidate.match.reference_from_scan);
  if (refined < candidate.log_likelihood - kSpread) return;
  candidate.log_likelihood = refined;
  candidate.map_from_sensor = candidate.match.reference_from_scan;
}

void Relocaliser::weigh(const BeamScan& scan, Location& location) const {
  auto& candidates = location.candidates;
  if (candidates.empty()) return;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.log_likelihood > b.log_likelihood; });
  std::vector<LocationCandidate> distinct;
  for (const auto& candidate : candidates) {
    const bool known = std::any_of(distinct.begin(), distinct.end(), [&](const LocationCandidate& other) {
      return distance(candidate.map_from_sensor, other.map_from_sensor) <= options_.same_distance &&
             turn(candidate.map_from_sensor, other.map_from_sensor) <= options_.same_angle;
    });
    if (!known) distinct.push_back(candidate);
  }
  candidates = std::move(distinct);
  const double beams = options_.independent_beams * static_cast<double>(scan.hits.size() + scan.misses.size());
  const double highest = std::max(candidates.front().log_likelihood, options_.nowhere);
  const double elsewhere = std::exp(beams * (options_.nowhere - highest));
  double sum = elsewhere;
  for (auto& candidate : candidates)
    sum += candidate.probability = std::exp(beams * (candidate.log_likelihood - highest));
  for (auto& candidate : candidates) candidate.probability /= sum;
  if (candidates.front().probability >= options_.min_confidence) {
    location.answer = Location::Answer::found;
  } else if (elsewhere / sum < 0.5) {
    location.answer = Location::Answer::ambiguous;
  }
}

}  // namespace omnimapper::matching
