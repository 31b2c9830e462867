#include <mrpt/maps/CPointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/PointToLineMatcher.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "Correspondences.h"

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

constexpr double kJudgedWithin = 0.3;  // [m] largest distance of a correspondence that counts for the overlap
constexpr double kJudgedLoss = 0.1;    // [m] scale of the loss for the covariance
// The scale of the loss is kSpreads times this quantile of the points' distances from their lines.
constexpr double kQuantile = 0.5, kSpreads = 4.5;
constexpr double kSmallestLoss = 0.07;  // [m]
// A point of the reference without a line holds a point of the scan in all directions, but with less weight than a
// line, because it may be clutter, or an edge that the next beam passes. It counts even less for which directions are
// constrained.
constexpr double kPointWeight = 0.6, kPointObservabilityWeight = 0.03;
// Noise share of the wide search: far from the solution, open directions are hard to recognize.
constexpr double kWideNoiseShare = 0.003;
constexpr double kReachOfLoss = 3;
constexpr double kShrink = 0.5;   // factor on the search radius, from one search of correspondences to the next
constexpr double kPull = 0.3;     // weight of the distances along the lines
constexpr double kNear = 0.01;    // [m] a shorter step ends the wide search
constexpr double kStill = 0.001;  // [m] a shorter step ends the match
constexpr double kLever = 5;      // [m] lever by which rotations count

// The motion from the guess to the pose, in the scan's frame.
Eigen::Vector3d motion(const TPose2D& guess, const TPose2D& pose) {
  const TPose2D moved = pose - guess;
  return {moved.x, moved.y, mrpt::math::wrapToPi(moved.phi)};
}

// Two Gauss-Newton steps with the same correspondences, because the weights change. Returns the larger step [m].
double refine(const Correspondences& correspondences, const MatchGuess& guess, double loss_scale, bool wide,
              TPose2D& pose) {
  const ObservableSubspace directions(correspondences.equations(pose, loss_scale, kPointObservabilityWeight, 0),
                                      wide ? kWideNoiseShare : ObservableSubspace::kNoiseShare);
  double largest = 0;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d step =
        directions.step(correspondences.equations(pose, loss_scale, kPointWeight, wide ? kPull : 0), guess.information,
                        motion(guess.reference_from_scan, pose));
    pose = pose + TPose2D(step.x(), step.y(), step.z());
    largest = std::max({largest, step.head<2>().norm(), kLever * std::abs(step.z())});
  }
  return largest;
}

ScanMatch toMatch(const Correspondences& correspondences, const ScanWithNormals& scan, const TPose2D& pose) {
  ScanMatch match;
  match.reference_from_scan = pose;
  if (correspondences.count() == 0) return match;
  const auto equations = correspondences.equations(pose, kJudgedLoss, kPointObservabilityWeight, 0);
  const ObservableSubspace directions(equations);
  match.overlap = static_cast<double>(correspondences.count()) / static_cast<double>(scan.size());
  match.wall_distance = equations.wallDistance();
  match.point_sigma = match.wall_distance * std::sqrt(static_cast<double>(scan.smoothing));
  match.unit_covariance = directions.covariance();
  match.degenerate = !directions.all();
  return match;
}

ScanWithNormals scanOf(const mrpt::maps::CMetricMap* map) {
  const auto* cloud = dynamic_cast<const mrpt::maps::CPointsMap*>(map);
  if (!cloud) throw base::Error(base::ExitCode::internal, "PointToLineMatcher aligns maps of points only");
  std::vector<Eigen::Vector2f> points;
  const auto& xs = cloud->getPointsBufferRef_x();
  const auto& ys = cloud->getPointsBufferRef_y();
  for (std::size_t i = 0; i < xs.size(); ++i) points.emplace_back(xs[i], ys[i]);
  return fitLines(points);
}

}  // namespace

std::shared_ptr<const MatchReference> PointToLineMatcher::prepare(ScanWithNormals reference) const {
  return std::make_shared<const PointIndex>(std::move(reference));
}

// The search is wide at first: correspondences may be far from each other, and their distance along the walls counts
// too, because lines alone would mislead from a distant pose. Later, only points on the same wall count; how far off
// they may lie follows from the residuals of most points.
ScanMatch PointToLineMatcher::match(const MatchReference& reference, const ScanWithNormals& scan,
                                    const MatchGuess& guess) const {
  Correspondences correspondences(dynamic_cast<const PointIndex&>(reference), scan);
  TPose2D pose = guess.reference_from_scan;
  double reach = options_.max_distance, loss_scale = options_.max_distance;
  bool wide = true, settled = false;
  for (int i = 0; i < options_.max_iterations; ++i) {
    correspondences.find(pose, reach);
    if (correspondences.count() == 0) return toMatch(correspondences, scan, guess.reference_from_scan);
    const double spread = kSpreads * correspondences.quantile(pose, kQuantile);
    loss_scale = std::clamp(spread, kSmallestLoss, std::max(kSmallestLoss, loss_scale));
    const double moved = refine(correspondences, guess, loss_scale, wide, pose);
    if (!wide && moved < kStill && reach < 1.01 * std::max(options_.min_distance, kReachOfLoss * loss_scale)) {
      if (settled) break;
      settled = true;
      const ObservableSubspace directions(correspondences.equations(pose, loss_scale, kPointObservabilityWeight, 0));
      if (directions.all()) break;
      // Undo the part of the wide search's motion along directions that have turned out to be open.
      const Eigen::Vector3d observable = directions.observablePart(motion(guess.reference_from_scan, pose));
      pose = guess.reference_from_scan + TPose2D(observable.x(), observable.y(), observable.z());
    }
    wide = wide && moved > kNear;
    if (!wide) reach = std::max(options_.min_distance, std::min(kShrink * reach, kReachOfLoss * loss_scale));
  }
  // Points that count less have helped to find the basin; now the others decide where in it the pose is.
  constexpr int kMostWeighed = 3;
  if (correspondences.weighPoints()) {
    for (int i = 0; i < kMostWeighed; ++i) {
      if (refine(correspondences, guess, loss_scale, false, pose) < kStill) break;
      correspondences.find(pose, reach);
    }
  }
  correspondences.find(pose, kJudgedWithin);
  return toMatch(correspondences, scan, pose);
}

ScanMatch PointToLineMatcher::judge(const MatchReference& reference, const ScanWithNormals& scan, const TPose2D& pose) {
  Correspondences correspondences(dynamic_cast<const PointIndex&>(reference), scan);
  correspondences.find(pose, kJudgedWithin);
  return toMatch(correspondences, scan, pose);
}

mrpt::poses::CPosePDF::Ptr PointToLineMatcher::AlignPDF(const mrpt::maps::CMetricMap* m1,
                                                        const mrpt::maps::CMetricMap* m2,
                                                        const mrpt::poses::CPosePDFGaussian& initialEstimationPDF,
                                                        mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult>) {
  const auto found = match(*prepare(scanOf(m1)), scanOf(m2), {initialEstimationPDF.mean.asTPose()});
  auto pdf = std::make_shared<mrpt::poses::CPosePDFGaussian>();
  pdf->mean = mrpt::poses::CPose2D(found.reference_from_scan);
  // MRPT's covariance is of x, y in the frame of m1.
  const double variance = std::max(1e-4, found.point_sigma * found.point_sigma);
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
