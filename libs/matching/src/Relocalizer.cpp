#include <omnimapper/matching/Relocalizer.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

constexpr double kTurn = 6.28318530717958647692;
constexpr double kMetresPerRadian = 2;              // distance that a difference in heading counts for in around()
constexpr double kAstray = 0.3, kAstrayTurn = 0.1;  // [m] [rad] by which the matcher may err along a corridor
constexpr double kHopeless = 0.3;  // difference of mean log-likelihoods to the best from which a candidate is hopeless
constexpr std::size_t kSectors = 30;
constexpr double kSpread = 0.05;  // how much mean log-likelihoods vary within a cell of the grid

double turn(const TPose2D& a, const TPose2D& b) {
  return std::abs(std::remainder(a.phi - b.phi, kTurn));
}
double distance(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

bool isNear(const LocationCandidate& a, const LocationCandidate& b, double most_distance, double most_turn) {
  return distance(a.map_from_sensor, b.map_from_sensor) <= most_distance &&
         turn(a.map_from_sensor, b.map_from_sensor) <= most_turn;
}

double mean(const std::vector<double>& values) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Mean difference of log-likelihood between `best` and `other`, less `lead_sigmas` standard errors of that mean.
// Neighbouring beams see the same objects, so the standard error is that of the means of kSectors sectors.
double leadOf(const std::vector<double>& best, const std::vector<double>& other, double lead_sigmas) {
  const std::size_t size = (best.size() + kSectors - 1) / kSectors;
  double sum = 0, squares = 0;
  std::vector<double> sectors;
  for (std::size_t begin = 0; begin < best.size(); begin += size) {
    const std::size_t end = std::min(begin + size, best.size());
    double part = 0;
    for (std::size_t i = begin; i < end; ++i) part += best[i] - other[i];
    sum += part;
    sectors.push_back(part / static_cast<double>(end - begin));
  }
  const double lead = sum / static_cast<double>(best.size()), count = static_cast<double>(sectors.size());
  for (const double sector : sectors) squares += (sector - lead) * (sector - lead);
  return lead - lead_sigmas * std::sqrt(squares / std::max(1.0, count * (count - 1)));
}

}  // namespace

Relocalizer::Relocalizer(std::vector<MapScan> map, std::shared_ptr<const ScanMatcher> matcher,
                         const RelocalizerOptions& options)
    : options_(options), matcher_(std::move(matcher)) {
  ScanWithNormals all;
  std::vector<grid::HitMissGrid::Placed> placed;
  for (MapScan& scan : map) {
    scan.scan = grid::finitePart(std::move(scan.scan));
    placed.push_back({scan.map_from_sensor, &scan.scan});
    map_.push_back({scan.map_from_sensor, fitLines(scan.scan.hits)});
    append(map_.back().lines, scan.map_from_sensor, all);
  }
  grid::LikelihoodOptions grid;
  grid.cell = options.cell;
  grid.sigma = options.sigma;
  grid.max_cells = options.beams.max_cells;
  pyramid_ = std::make_unique<const grid::LikelihoodPyramid>(all.points, grid);
  beams_ = std::make_unique<const grid::HitMissGrid>(placed, options.beams);
}

Location Relocalizer::locate(const grid::BeamScan& scan, const std::optional<SearchWindow>& window) const {
  return locateTogether({{{}, scan}}, window);
}

Location Relocalizer::locateTogether(std::vector<LocalScan> scans, const std::optional<SearchWindow>& window) const {
  const Query query = queryOf(std::move(scans));
  const SearchWindow searched = window ? *window : SearchWindow::everywhere(*pyramid_, 0);
  auto found = candidates(query, searched, options_.min_share_of_best, options_.max_candidates);
  const bool explained = std::any_of(found.begin(), found.end(),
                                     [&](const LocationCandidate& one) { return one.log_likelihood >= options_.poor; });
  if (!found.empty() && !explained) {
    found = candidates(query, searched, options_.min_share_if_poor, 2 * options_.max_candidates);
  }
  return judged(std::move(found), query);
}

Relocalizer::Query Relocalizer::queryOf(std::vector<LocalScan> scans) const {
  Query query;
  ScanWithNormals sought;
  for (LocalScan& scan : scans) {
    scan.scan = grid::finitePart(std::move(scan.scan));
    const ScanWithNormals lines = fitLines(scan.scan.hits);
    append(lines, scan.local_from_sensor, query.lines);
    const auto points = thinned(lines.points, options_.spacing);
    append({points, {points.size(), Eigen::Vector2f::Zero()}, {}, {}}, scan.local_from_sensor, sought);
  }
  if (scans.size() > 1) sought = voxelDownsample(sought, options_.spacing);
  query.sought = std::move(sought.points);
  query.scans = std::move(scans);
  return query;
}

std::vector<double> Relocalizer::logLikelihoods(const Query& query, const TPose2D& map_from_local) const {
  std::vector<double> all;
  for (const LocalScan& scan : query.scans) {
    const auto some = beams_->logLikelihoods(scan.scan, map_from_local + scan.local_from_sensor);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<LocationCandidate> Relocalizer::candidates(const Query& query, const SearchWindow& window, double min_share,
                                                       int most) const {
  SearchOptions search_options;
  search_options.min_score = options_.min_score;
  search_options.min_share_of_best = min_share;
  search_options.max_results = most;
  search_options.max_blocks = options_.max_blocks;
  std::vector<LocationCandidate> result;
  for (const auto& place : search(*pyramid_, query.sought, window, search_options)) {
    result.push_back(refined(place, query));
  }
  return result;
}

// The lines of those scans of the map that are nearest to a pose.
ScanWithNormals Relocalizer::around(const TPose2D& pose) const {
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < map_.size(); ++i) {
    const TPose2D& other = map_[i].map_from_sensor;
    nearest.emplace_back(distance(pose, other) + kMetresPerRadian * turn(pose, other), i);
  }
  const auto count = std::min<std::size_t>(nearest.size(), options_.reference_scans);
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count), nearest.end());
  ScanWithNormals result;
  for (std::size_t k = 0; k < count; ++k) {
    const Placed& near = map_[nearest[k].second];
    append(near.lines, near.map_from_sensor, result);
  }
  return result;
}

// Refines a place by the matcher. The candidate stays where it is if its beams are less likely at the pose that the
// matcher finds.
LocationCandidate Relocalizer::refined(const SearchResult& place, const Query& query) const {
  const TPose2D& pose = place.map_from_scan;
  LocationCandidate candidate;
  candidate.score = place.score;
  candidate.match = matcher_->match(*matcher_->prepare(around(pose)), query.lines, {pose});
  candidate.map_from_sensor = candidate.match.reference_from_scan;
  candidate.log_likelihood = mean(logLikelihoods(query, candidate.map_from_sensor));
  const double unmoved = mean(logLikelihoods(query, pose));
  if (candidate.log_likelihood < unmoved - kSpread) {
    candidate.map_from_sensor = pose;
    candidate.log_likelihood = unmoved;
  }
  return candidate;
}

// Moves a candidate, by at most kAstray, to where the beams are likeliest.
void Relocalizer::settle(LocationCandidate& candidate, const Query& query) const {
  const TPose2D pose = candidate.map_from_sensor;
  TPose2D best = pose;
  auto logarithms = logLikelihoods(query, pose);
  double step = 0.05, turn_step = 0.01;
  for (int pass = 0; pass < 5; ++pass) {
    bool better = false;
    for (int direction = 0; direction < 6; ++direction) {
      const double sign = direction % 2 == 0 ? 1 : -1;
      TPose2D tried = best;
      (direction < 2 ? tried.x : direction < 4 ? tried.y : tried.phi) += sign * (direction < 4 ? step : turn_step);
      if (distance(tried, pose) > kAstray || turn(tried, pose) > kAstrayTurn) continue;
      auto there = logLikelihoods(query, tried);
      if (mean(there) <= mean(logarithms)) continue;
      logarithms = std::move(there);
      best = tried;
      better = true;
    }
    if (better) continue;
    step /= 2;
    turn_step /= 2;
  }
  candidate.map_from_sensor = best;
  candidate.log_likelihood = mean(logarithms);
  candidate.beams = std::move(logarithms);
}

// Sorts candidates, the best first, and keeps the best one of those that are the same.
void Relocalizer::sortAndMerge(std::vector<LocationCandidate>& candidates) const {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.log_likelihood > b.log_likelihood; });
  std::vector<LocationCandidate> distinct;
  for (const auto& candidate : candidates) {
    const auto isSame = [&](const LocationCandidate& other) {
      return isNear(candidate, other, options_.same_distance, options_.same_angle);
    };
    if (std::none_of(distinct.begin(), distinct.end(), isSame)) distinct.push_back(candidate);
  }
  candidates = std::move(distinct);
}

Location Relocalizer::judged(std::vector<LocationCandidate> candidates, const Query& query) const {
  Location location;
  if (candidates.empty()) return location;
  sortAndMerge(candidates);
  const double hopeless = candidates.front().log_likelihood - kHopeless;
  for (auto& candidate : candidates) {
    if (candidate.log_likelihood < hopeless) break;
    settle(candidate, query);
  }
  sortAndMerge(candidates);
  location.candidates = std::move(candidates);
  const auto& first = location.candidates.front();
  const double beams = std::min(options_.most_beams, static_cast<int>(first.beams.size()));
  const double nowhere = std::exp(std::min(50.0, beams * (options_.nowhere - first.log_likelihood)));
  double sum = nowhere, here = 0;
  for (auto& candidate : location.candidates) {
    const double lead = candidate.beams.empty() ? first.log_likelihood - candidate.log_likelihood
                                                : leadOf(first.beams, candidate.beams, options_.lead_sigmas);
    sum += candidate.probability = std::exp(-beams * std::max(0.0, lead));
    if (isNear(candidate, first, options_.place_distance, options_.place_angle)) here += candidate.probability;
  }
  for (auto& candidate : location.candidates) candidate.probability /= sum;
  if (here / sum >= options_.min_confidence) {
    location.answer = Location::Answer::found;
  } else if (nowhere / sum < 0.5) {
    location.answer = Location::Answer::ambiguous;
  }
  return location;
}

}  // namespace omnimapper::matching
