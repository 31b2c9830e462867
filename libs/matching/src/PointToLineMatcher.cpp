#include <mrpt/maps/CPointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/PointToLineMatcher.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "LinePartners.h"

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

constexpr double kJudgedWithin = 0.3;  // [m] of a partner for the overlap
constexpr double kJudgedLoss = 0.1;    // [m]

ScanMatch toMatch(const LinePartners& partners, std::size_t points, const TPose2D& pose) {
  ScanMatch match;
  match.reference_from_scan = pose;
  if (partners.near == 0) return match;
  const FixedDirections directions(partners);
  match.overlap = static_cast<double>(partners.near) / static_cast<double>(points);
  match.wall_distance = partners.wallDistance();
  match.unit_covariance = directions.covariance();
  match.degenerate = !directions.all();
  return match;
}

PlanarScan scanOf(const mrpt::maps::CMetricMap* map) {
  const auto* cloud = dynamic_cast<const mrpt::maps::CPointsMap*>(map);
  if (!cloud) throw base::Error(base::ExitCode::internal, "PointToLineMatcher aligns maps of points only");
  std::vector<Eigen::Vector2f> points;
  const auto& xs = cloud->getPointsBufferRef_x();
  const auto& ys = cloud->getPointsBufferRef_y();
  for (std::size_t i = 0; i < xs.size(); ++i) points.emplace_back(xs[i], ys[i]);
  return fitLines(points);
}

}  // namespace

std::shared_ptr<const MatchReference> PointToLineMatcher::prepare(PlanarScan reference) const {
  return std::make_shared<const PointIndex>(std::move(reference));
}

ScanMatch PointToLineMatcher::match(const MatchReference& reference, const PlanarScan& scan,
                                    const MatchGuess& guess) const {
  const auto& index = dynamic_cast<const PointIndex&>(reference);
  TPose2D pose = guess.reference_from_scan;
  double reach = options_.max_distance, loss_scale = options_.max_distance;
  for (int i = 0; i < options_.max_iterations; ++i) {
    const auto partners = findPartners(index, scan, pose, reach, loss_scale);
    if (partners.near == 0) return toMatch(partners, scan.size(), guess.reference_from_scan);
    const TPose2D moved = pose - guess.reference_from_scan;
    const Eigen::Vector3d from_guess(moved.x, moved.y, mrpt::math::wrapToPi(moved.phi));
    const Eigen::Vector3d step = FixedDirections(partners).step(partners.gradient, guess.information, from_guess);
    pose = pose + TPose2D(step.x(), step.y(), step.z());
    // Wide at first, then only what lies on the same wall as well as most points do.
    const double spread = 3 * partners.wallDistance();
    loss_scale = std::clamp(spread, options_.min_distance, 0.7 * loss_scale + 0.3 * options_.min_distance);
    reach = std::max(options_.min_distance, std::min(reach, 3 * loss_scale));
    const bool still = step.head<2>().norm() < 2e-4 && std::abs(step.z()) < 2e-5;
    if (still && loss_scale < 1.01 * std::max(options_.min_distance, spread)) break;
  }
  return judge(reference, scan, pose);
}

ScanMatch PointToLineMatcher::judge(const MatchReference& reference, const PlanarScan& scan, const TPose2D& pose) {
  const auto& index = dynamic_cast<const PointIndex&>(reference);
  return toMatch(findPartners(index, scan, pose, kJudgedWithin, kJudgedLoss), scan.size(), pose);
}

mrpt::poses::CPosePDF::Ptr PointToLineMatcher::AlignPDF(const mrpt::maps::CMetricMap* m1,
                                                        const mrpt::maps::CMetricMap* m2,
                                                        const mrpt::poses::CPosePDFGaussian& initialEstimationPDF,
                                                        mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult>) {
  const auto found = match(*prepare(scanOf(m1)), scanOf(m2), {initialEstimationPDF.mean.asTPose()});
  auto pdf = std::make_shared<mrpt::poses::CPosePDFGaussian>();
  pdf->mean = mrpt::poses::CPose2D(found.reference_from_scan);
  // MRPT's covariance is of x, y in the frame of m1.
  const double variance = std::max(1e-4, found.wall_distance * found.wall_distance);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(found.reference_from_scan.phi).toRotationMatrix();
  pdf->cov = mrpt::math::CMatrixDouble33(Eigen::Matrix3d(variance * turn * found.unit_covariance * turn.transpose()));
  return pdf;
}

mrpt::poses::CPose3DPDF::Ptr PointToLineMatcher::Align3DPDF(const mrpt::maps::CMetricMap*,
                                                            const mrpt::maps::CMetricMap*,
                                                            const mrpt::poses::CPose3DPDFGaussian&,
                                                            mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult>) {
  throw base::Error(base::ExitCode::internal, "PointToLineMatcher aligns maps in the plane only");
}

}  // namespace omnimapper::matching
