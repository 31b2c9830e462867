#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>
#include <omnimapper/matching/IcpMatcher.h>

#include <Eigen/LU>
#include <cmath>

namespace omnimapper::matching {

struct IcpMatcher::Icp {
  mutable mrpt::slam::CICP algorithm;
};

namespace {

// Normal of the reference near a point, from the two nearest reference points; none if they coincide.
struct Partner {
  double distance;
  Eigen::Vector2d normal;
};

bool findPartner(const mrpt::maps::CSimplePointsMap& reference, float x, float y, double max_distance,
                 Partner& partner) {
  float x1, y1, x2, y2, squared1, squared2;
  reference.kdTreeTwoClosestPoint2D(x, y, x1, y1, x2, y2, squared1, squared2);
  partner.distance = std::sqrt(squared1);
  if (partner.distance > max_distance) return false;
  const Eigen::Vector2d along(x2 - x1, y2 - y1);
  const double length = along.norm();
  if (length < 1e-3) return false;
  partner.normal = Eigen::Vector2d(-along.y(), along.x()) / length;
  return true;
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
          .integer("icp_decimation", &Options::decimation, base::Range{1, 1000}, "Pairs every n-th point only.");
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

ScanMatch IcpMatcher::match(const mrpt::maps::CSimplePointsMap& reference, const mrpt::maps::CSimplePointsMap& scan,
                            const mrpt::math::TPose2D& guess) const {
  ScanMatch result;
  result.reference_from_scan = guess;
  result.unit_covariance = Eigen::Matrix3d::Identity() * 1e6;
  if (reference.size() < 2 || scan.empty()) return result;

  const auto found = icp_->algorithm.Align(&reference, &scan, mrpt::poses::CPose2D(guess));
  const mrpt::math::TPose2D pose = found->getMeanVal().asTPose();
  if (!std::isfinite(pose.x) || !std::isfinite(pose.y) || !std::isfinite(pose.phi)) return result;
  result.reference_from_scan = pose;

  // Point-to-line information of the partners at the solution, in the scan's frame.
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * 1e-6;
  std::size_t partners = 0;
  double distances = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    float px, py, pz;
    scan.getPointFast(i, px, py, pz);
    const auto x = static_cast<float>(pose.x + c * px - s * py), y = static_cast<float>(pose.y + s * px + c * py);
    Partner partner;
    if (!findPartner(reference, x, y, 2 * options_.min_distance, partner)) continue;
    ++partners;
    distances += partner.distance;
    const Eigen::Vector2d normal_in_scan(c * partner.normal.x() + s * partner.normal.y(),
                                         -s * partner.normal.x() + c * partner.normal.y());
    const Eigen::Vector3d row(normal_in_scan.x(), normal_in_scan.y(), normal_in_scan.dot(Eigen::Vector2d(-py, px)));
    information += row * row.transpose();
  }
  if (partners == 0) return result;
  result.overlap = static_cast<double>(partners) / static_cast<double>(scan.size());
  result.mean_distance = distances / static_cast<double>(partners);
  result.unit_covariance = information.inverse();
  return result;
}

}  // namespace omnimapper::matching
