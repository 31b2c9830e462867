#include <omnimapper/matching/ScanTracker.h>

#include <cmath>
#include <cstddef>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

bool isBeyond(const TPose2D& motion, double distance, double angle) {
  return std::hypot(motion.x, motion.y) > distance || std::abs(mrpt::math::wrapToPi(motion.phi)) > angle;
}

}  // namespace

const base::OptionTable<ScanTrackerOptions>& ScanTrackerOptions::table() {
  using Options = ScanTrackerOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer("local_scans", &Options::local_scans, base::Range{1, 1000},
                   "Scans of the local map that a scan is matched against.")
          .number("local_distance_m", &Options::local_distance, base::Range::positive(), "Way between them.")
          .number("local_angle_deg", &Options::local_angle, base::Range{0.1, 180}, "Turn between them.")
          .number("min_overlap", &Options::min_overlap, base::Range{0, 1},
                  "Share of the points that must find a partner.")
          .number("max_correction_m", &Options::max_correction, base::Range::positive(),
                  "A match farther from the prediction is refused.")
          .number("max_turn_correction_deg", &Options::max_turn_correction, base::Range{0, 180},
                  "A match turned farther from the prediction is refused.");
  return table;
}

void ScanTracker::restart(const PlanarScan& scan) {
  locals_.clear();
  track_from_last_ = {};
  remember(scan);
}

std::optional<ScanTracker::Tracked> ScanTracker::track(const PlanarScan& scan, const std::vector<MatchGuess>& guesses) {
  if (!reference_ || scan.empty()) return std::nullopt;
  const TPose2D local_from_last = track_from_last_ - locals_.back().track_from_scan;
  for (std::size_t i = 0; i < guesses.size(); ++i) {
    const TPose2D local_from_guess = local_from_last + guesses[i].reference_from_scan;
    auto match = matcher_->match(*reference_, scan, {local_from_guess, guesses[i].information});
    if (match.overlap < options_.min_overlap) continue;
    if (isBeyond(match.reference_from_scan - local_from_guess, options_.max_correction, options_.max_turn_correction))
      continue;
    track_from_last_ = locals_.back().track_from_scan + match.reference_from_scan;
    if (isBeyond(match.reference_from_scan, options_.local_distance, options_.local_angle)) remember(scan);
    match.reference_from_scan = match.reference_from_scan - local_from_last;
    return Tracked{match, i};
  }
  return std::nullopt;
}

void ScanTracker::remember(const PlanarScan& scan) {
  locals_.push_back({track_from_last_, scan});
  if (locals_.size() > static_cast<std::size_t>(options_.local_scans)) locals_.pop_front();
  PlanarScan local_map;
  for (const auto& local : locals_) append(local.scan, local.track_from_scan - track_from_last_, local_map);
  reference_ = matcher_->prepare(std::move(local_map));
}

}  // namespace omnimapper::matching
