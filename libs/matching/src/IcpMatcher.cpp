#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>
#include <omnimapper/matching/IcpMatcher.h>
#include <omnimapper/matching/PointToLineMatcher.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "PointIndex.h"

namespace omnimapper::matching {

namespace {

// [m] Largest distance of a point from its wall when the result of ICP is refined.
constexpr double kRefinedWithin = 0.3;

mrpt::maps::CSimplePointsMap pointsMap(const ScanWithNormals& scan) {
  mrpt::maps::CSimplePointsMap map;
  map.reserve(scan.size());
  for (const auto& point : scan.points) map.insertPointFast(point.x(), point.y(), 0);
  return map;
}

// MRPT's maps build their search tree when it is first needed, so matches against the same one must take turns.
struct IcpReference : PointIndex {
  explicit IcpReference(ScanWithNormals scan) : PointIndex(scan), map(pointsMap(scan)) {}
  mrpt::maps::CSimplePointsMap map;
  mutable std::mutex turn;
};

}  // namespace

std::shared_ptr<const MatchReference> IcpMatcher::prepare(ScanWithNormals reference) const {
  return std::make_shared<const IcpReference>(std::move(reference));
}

ScanMatch IcpMatcher::match(const MatchReference& reference, const ScanWithNormals& scan,
                            const MatchGuess& guess) const {
  const auto& icp_reference = dynamic_cast<const IcpReference&>(reference);
  ScanMatch nothing;
  nothing.reference_from_scan = guess.reference_from_scan;
  if (icp_reference.size() < 2 || scan.empty()) return nothing;
  mrpt::slam::CICP icp;
  auto& config = icp.options;
  config.ICP_algorithm =
      options_.icp_method == IcpMethod::classic ? mrpt::slam::icpClassic : mrpt::slam::icpLevenbergMarquardt;
  config.thresholdDist = options_.max_distance;
  config.smallestThresholdDist = options_.min_distance;
  config.thresholdAng = options_.icp_max_angle;
  config.maxIterations = static_cast<unsigned>(options_.max_iterations);
  config.corresponding_points_decimation = static_cast<std::uint32_t>(options_.icp_decimation);
  config.minAbsStep_trans = 1e-4;
  config.minAbsStep_rot = 1e-4;
  config.skip_cov_calculation = true;
  config.skip_quality_calculation = true;
  const auto scan_map = pointsMap(scan);
  const std::lock_guard lock(icp_reference.turn);
  const auto found = icp.Align(&icp_reference.map, &scan_map, mrpt::poses::CPose2D(guess.reference_from_scan));
  const auto pose = found->getMeanVal().asTPose();
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) return nothing;
  // ICP shifts the scan along the walls, depending on where these were sampled; matching with their lines corrects
  // that.
  auto refining = options_;
  refining.max_distance = std::min(options_.max_distance, kRefinedWithin);
  auto match = PointToLineMatcher(refining).match(reference, scan, pose);
  if (match.overlap == 0) match.reference_from_scan = guess.reference_from_scan;
  return match;
}

}  // namespace omnimapper::matching
