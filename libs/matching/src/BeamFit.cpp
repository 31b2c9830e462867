#include <omnimapper/matching/BeamFit.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

// Every n-th beam, so that about as many as wanted are left.
std::vector<Eigen::Vector2f> thinnedTo(const std::vector<Eigen::Vector2f>& beams, std::size_t wanted) {
  const std::size_t every = 1 + beams.size() / wanted;
  std::vector<Eigen::Vector2f> some;
  for (std::size_t i = 0; i < beams.size(); i += every) some.push_back(beams[i]);
  return some;
}

}  // namespace

BeamFit bestFit(const grid::HitMissGrid& map, const grid::BeamScan& beams, const TPose2D& map_from_sensor,
                double distance, double angle) {
  constexpr std::size_t kBeams = 90;     // of hits, and of misses
  constexpr double kContradicts = -2.5;  // log-likelihood of a beam
  grid::BeamScan some;
  some.hits = thinnedTo(beams.hits, kBeams);
  some.misses = thinnedTo(beams.misses, kBeams);
  if (some.hits.empty() && some.misses.empty()) return {};
  const int steps = distance > 0 || angle > 0 ? 4 : 0;  // to either side
  BeamFit best{-std::numeric_limits<double>::infinity(), 1};
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      for (int k = -steps; k <= steps; ++k) {
        const double share = steps == 0 ? 0 : 1.0 / steps;
        const TPose2D pose(map_from_sensor.x + share * i * distance, map_from_sensor.y + share * j * distance,
                           map_from_sensor.phi + share * k * angle);
        const auto fits = map.logLikelihoods(some, pose);
        const auto count = static_cast<double>(fits.size());
        const auto contradicting =
            std::count_if(fits.begin(), fits.end(), [](double fit) { return fit < kContradicts; });
        best.log_likelihood = std::max(best.log_likelihood, std::accumulate(fits.begin(), fits.end(), 0.0) / count);
        best.contradicting = std::min(best.contradicting, static_cast<double>(contradicting) / count);
      }
    }
  }
  return best;
}

}  // namespace omnimapper::matching
