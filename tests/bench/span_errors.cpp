// Whether the covariances of laser odometry are consistent. Spans of 0.5 to 50 m travelled of every available 2D laser
// log are used. The error of the motion by ScanOdometryPlugin with its defaults is divided by its standard deviation,
// and the root mean square is printed: forwards, to the left, in heading, and of all three together. 1 is right, more
// is overconfident. Spans in which one of the three is off by more than 5 sigma are counted.
//
// The reference of a recording has errors, too. They are estimated from neighbouring poses, between which our own error
// is smallest: from the median difference to our motion, so that slips do not count, assuming a normal distribution and
// the same error at both ends. They are added to the covariance; the error of heading at the beginning acts with the
// span as its lever.
//
// Example: bench-span_errors -o out/robustness
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/Covariance.h>
#include <omnimapper/obs/registerClasses.h>

#include <CLI/CLI.hpp>
#include <Eigen/LU>

#include "UntunedLogs.h"
#include "laser2d/ScanOdometryPlugin.h"

namespace {

using namespace omnimapper;
using geometry::Se2;

Se2 planar(const geometry::Se3& pose) {
  const Eigen::Vector3d forwards = pose.rotation * Eigen::Vector3d::UnitX();
  return {pose.translation.x(), pose.translation.y(), std::atan2(forwards.y(), forwards.x())};
}

// A measured motion over a span, and its error against the reference and its covariance in the frame of the end.
struct Span {
  Se2 motion;
  Eigen::Vector3d error;
  Eigen::Matrix3d covariance;
};

// Consecutive spans between poses of the reference, each of at least `travel` [m] travelled.
std::vector<Span> spansOf(const plugins::ScanOdometryPlugin& odometry, const eval::Trajectory& reference,
                          double travel) {
  std::vector<Span> spans;
  const auto travelled = eval::distanceTravelled(reference);
  for (std::size_t begin = 0, end = 1; end < reference.size(); ++end) {
    if (travelled[end] - travelled[begin] < travel) continue;
    const auto measured = odometry.between(reference[begin].stamp, reference[end].stamp);
    if (measured) {
      const Se2 motion = planar(geometry::fromMrpt(measured->begin_from_end)),
                error = inverse(motion) * inverse(planar(reference[begin].world_from_body)) *
                        planar(reference[end].world_from_body);
      spans.push_back({motion, {error.x, error.y, error.yaw}, geometry::planarPart(measured->covariance)});
    }
    begin = end;
  }
  return spans;
}

// Standard deviations of a pose of the reference: forwards and to the left [m], heading [rad].
Eigen::Vector3d sigmasOfReference(const std::vector<Span>& neighbours) {
  Eigen::Vector3d sigmas = Eigen::Vector3d::Zero();
  if (neighbours.empty()) return sigmas;
  for (int i = 0; i < 3; ++i) {
    std::vector<double> off;
    for (const auto& span : neighbours) off.push_back(std::abs(span.error[i]));
    std::nth_element(off.begin(), off.begin() + off.size() / 2, off.end());
    sigmas[i] = 1.4826 * off[off.size() / 2] / std::sqrt(2.0);
  }
  return sigmas;
}

Eigen::Matrix3d covarianceOfReference(const Se2& motion, const Eigen::Vector3d& sigmas) {
  const Eigen::Matrix3d each = sigmas.cwiseAbs2().asDiagonal();
  // An error of heading at the beginning moves the end sideways, in the frame of the end.
  const Eigen::Matrix2d turned = motion.rotation().transpose();
  Eigen::Matrix3d end_from_begin = Eigen::Matrix3d::Identity();
  end_from_begin.topLeftCorner<2, 2>() = turned;
  end_from_begin.topRightCorner<2, 1>() = turned * Eigen::Vector2d(-motion.y, motion.x);
  return each + end_from_begin * each * end_from_begin.transpose();
}

struct Normalized {
  std::size_t spans = 0, beyond_5_sigma = 0;
  Eigen::Vector3d by_direction = Eigen::Vector3d::Zero();  // root mean squares of the normalized errors
  double all = 0;
};

Normalized normalized(const std::vector<Span>& spans, const Eigen::Vector3d& sigmas) {
  Normalized result;
  for (const auto& span : spans) {
    const Eigen::Matrix3d covariance = span.covariance + covarianceOfReference(span.motion, sigmas);
    const Eigen::Vector3d squares = span.error.cwiseAbs2().cwiseQuotient(covariance.diagonal());
    ++result.spans;
    result.by_direction += squares;
    result.all += span.error.dot(covariance.inverse() * span.error) / 3;
    result.beyond_5_sigma += squares.maxCoeff() > 25;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, result.spans));
  result.by_direction = (result.by_direction / count).cwiseSqrt();
  result.all = std::sqrt(result.all / count);
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  std::string out;
  std::vector<std::string> names, variant_names{"as it is"};
  double reference_share = 1;
  CLI::App app("Measures the errors of laser odometry over spans of distance travelled, in standard deviations.");
  app.add_option("-o,--output", out, "folder for logs of the simulator; logs that are there already are used again")
      ->required();
  app.add_option("--logs", names, "only these logs")->delimiter(',');
  app.add_option("--variants", variant_names, "variants of the logs (as it is)")->delimiter(',');
  app.add_option("--reference-share", reference_share, "share of the references' estimated errors that is added");
  CLI11_PARSE(app, argc, argv);
  obs::registerClasses();

  std::printf(
      "| log | reference [mm, deg] | distance travelled [m] | spans | forwards | left | heading | all | beyond 5 sigma "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& log : untuned::logsAtHand(out)) {
    if (!names.empty() && std::find(names.begin(), names.end(), log.name) == names.end()) continue;
    const bool is_exact = log.name == "simul" || log.name == "range_030_bearing_015" || log.name.find("simulated") == 0;
    const auto observations = untuned::read(log);
    for (const auto variant : omnimapper::testing::allLogVariants()) {
      const std::string name = omnimapper::testing::nameOf(variant);
      if (std::find(variant_names.begin(), variant_names.end(), name) == variant_names.end()) continue;
      plugins::ScanOdometryPlugin odometry({}, {}, {}, {});
      const auto heard = omnimapper::testing::variantOf(observations, variant);
      for (const auto& observation : heard) odometry.add(observation);
      odometry.processUntil(heard.back()->timestamp);
      const auto reference = untuned::truthOf(log, observations, variant);
      Eigen::Vector3d sigmas = Eigen::Vector3d::Zero();
      if (!is_exact) sigmas = reference_share * sigmasOfReference(spansOf(odometry, reference, 0.3));
      for (const double travel : {0.5, 2.0, 10.0, 50.0}) {
        const auto one = normalized(spansOf(odometry, reference, travel), sigmas);
        if (one.spans == 0) continue;
        std::printf("| %s%s | %.0f %.0f, %.2f | %g | %zu | %.2f | %.2f | %.2f | %.2f | %zu |\n", log.name.c_str(),
                    variant_names.size() > 1 ? (", " + name).c_str() : "", 1000 * sigmas[0], 1000 * sigmas[1],
                    sigmas[2] / base::option_text::kRadiansPerDegree, travel, one.spans, one.by_direction[0],
                    one.by_direction[1], one.by_direction[2], one.all, one.beyond_5_sigma);
      }
      std::fflush(stdout);
    }
  }
}
