#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>
#include <omnimapper/matching/IcpMatcher.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace omnimapper::matching {

struct IcpMatcher::Icp {
  mutable mrpt::slam::CICP algorithm;
};

namespace {

using mrpt::math::TPose2D;

// Point-to-line normal equations of all points of a scan that have a partner on a wall, at one pose.
struct WallPartners {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  // of x y yaw in the scan's frame, unit variance a point
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double squared_distance = 0, weight = 0;
  std::size_t near = 0;  // points with any partner

  double wallDistance() const { return weight > 0 ? std::sqrt(squared_distance / weight) : 0; }
};

WallPartners findWallPartners(const PlanarScan& reference, const PlanarScan& scan, const TPose2D& pose,
                              double max_distance, double loss_scale) {
  WallPartners partners;
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  const auto& xs = scan.points.getPointsBufferRef_x();
  const auto& ys = scan.points.getPointsBufferRef_y();
  const auto& reference_xs = reference.points.getPointsBufferRef_x();
  const auto& reference_ys = reference.points.getPointsBufferRef_y();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double x = pose.x + c * xs[i] - s * ys[i], y = pose.y + s * xs[i] + c * ys[i];
    float squared;
    const std::size_t nearest =
        reference.points.kdTreeClosestPoint2D(static_cast<float>(x), static_cast<float>(y), squared);
    if (squared > max_distance * max_distance) continue;
    ++partners.near;
    const Eigen::Vector2d normal = reference.normals[nearest].cast<double>();
    if (normal.isZero()) continue;
    const double across = normal.x() * (x - reference_xs[nearest]) + normal.y() * (y - reference_ys[nearest]);
    const double weight = 1 / (1 + across * across / (loss_scale * loss_scale));
    const Eigen::Vector2d normal_in_scan(c * normal.x() + s * normal.y(), -s * normal.x() + c * normal.y());
    const Eigen::Vector3d row(normal_in_scan.x(), normal_in_scan.y(),
                              -ys[i] * normal_in_scan.x() + xs[i] * normal_in_scan.y());
    partners.information += weight * row * row.transpose();
    partners.gradient += weight * across * row;
    partners.squared_distance += weight * across * across;
    partners.weight += weight;
  }
  // A direction that no wall fixes stays where the guess has it.
  partners.information.diagonal() += Eigen::Vector3d::Constant(1e-3);
  return partners;
}

TPose2D moved(const TPose2D& pose, const Eigen::Vector3d& step) {
  return pose + TPose2D(step.x(), step.y(), step.z());
}

}  // namespace

const base::OptionTable<IcpOptions>& IcpOptions::table() {
  using Options = IcpOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("icp_method", &Options::method,
                  {{"classic", IcpMethod::classic}, {"levenberg_marquardt", IcpMethod::levenberg_marquardt}},
                  "Variant of MRPT's ICP.")
          .number("icp_max_distance_m", &Options::max_distance, base::Range::positive(),
                  "Largest distance of paired points at the start.")
          .number("icp_min_distance_m", &Options::min_distance, base::Range::positive(),
                  "Largest distance of paired points at the end.")
          .number("icp_max_angle_deg", &Options::max_angle, base::Range{0, 45},
                  "Widens the pairing distance with the distance from the sensor.")
          .integer("icp_max_iterations", &Options::max_iterations, base::Range{1, 10000}, "Iterations at most.")
          .integer("icp_decimation", &Options::decimation, base::Range{1, 1000}, "Pairs every n-th point only.")
          .integer("icp_refinements", &Options::refinements, base::Range{0, 1000},
                   "Point-to-line iterations after MRPT's ICP; 0 for none.")
          .number("icp_refinement_distance_m", &Options::refinement_distance, base::Range::positive(),
                  "Largest distance of a point from its wall in them.");
  return table;
}

IcpMatcher::IcpMatcher(const IcpOptions& options) : icp_(std::make_unique<Icp>()), options_(options) {
  auto& config = icp_->algorithm.options;
  config.ICP_algorithm =
      options.method == IcpMethod::classic ? mrpt::slam::icpClassic : mrpt::slam::icpLevenbergMarquardt;
  config.thresholdDist = options.max_distance;
  config.smallestThresholdDist = options.min_distance;
  config.thresholdAng = options.max_angle;
  config.maxIterations = static_cast<unsigned>(options.max_iterations);
  config.corresponding_points_decimation = static_cast<std::uint32_t>(options.decimation);
  config.minAbsStep_trans = 1e-4;
  config.minAbsStep_rot = 1e-4;
  config.skip_cov_calculation = true;
  config.skip_quality_calculation = true;
}

IcpMatcher::~IcpMatcher() = default;

ScanMatch IcpMatcher::match(const PlanarScan& reference, const PlanarScan& scan, const TPose2D& guess) const {
  ScanMatch result;
  result.reference_from_scan = guess;
  result.unit_covariance = Eigen::Matrix3d::Identity() * 1e6;
  if (reference.size() < 2 || scan.empty()) return result;

  const auto found = icp_->algorithm.Align(&reference.points, &scan.points, mrpt::poses::CPose2D(guess));
  TPose2D pose = found->getMeanVal().asTPose();
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) return result;

  // Wide at first, then only what lies on the same wall as well as most points do.
  double loss_scale = options_.refinement_distance;
  for (int i = 0; i < options_.refinements; ++i) {
    const auto partners = findWallPartners(reference, scan, pose, options_.refinement_distance, loss_scale);
    const Eigen::Vector3d step = partners.information.ldlt().solve(-partners.gradient);
    pose = moved(pose, step);
    loss_scale = std::max(options_.min_distance, 2 * partners.wallDistance());
    if (i >= 2 && step.head<2>().norm() < 1e-4 && std::abs(step.z()) < 1e-5) break;
  }
  const auto partners = findWallPartners(reference, scan, pose, options_.refinement_distance, loss_scale);
  result.reference_from_scan = pose;
  result.overlap = static_cast<double>(partners.near) / static_cast<double>(scan.size());
  result.wall_distance = partners.wallDistance();
  result.unit_covariance = partners.information.inverse();
  return result;
}

}  // namespace omnimapper::matching
