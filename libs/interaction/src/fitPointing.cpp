#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/interaction/fitPointing.h>

#include <Eigen/Core>
#include <cmath>
#include <map>

namespace omnimapper::interaction {

namespace {

// The four angles of a sample: theta and psi of elbow-hand, then of head-hand.
using Angles = Eigen::Vector4d;

Angles anglesOf(const PointingSample& sample) {
  return {sample.elbow_hand.theta, sample.elbow_hand.psi, sample.head_hand.theta, sample.head_hand.psi};
}

RayErrors rayErrors(const Angles& mean, const Angles& sigma, int first) {
  return {{mean[first], sigma[first]}, {mean[first + 1], sigma[first + 1]}};
}

struct Moments {
  Angles sum = Angles::Zero();
  std::size_t count = 0;
  void add(const Angles& angles) { sum += angles, ++count; }
  Angles mean() const { return sum / static_cast<double>(count); }
};

TargetDirection meanDirection(const std::vector<const PointingSample*>& samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto* sample : samples) {
    const auto& d = sample->direction;
    sum += Eigen::Vector3d(std::cos(d.altitude) * std::cos(d.azimuth), std::cos(d.altitude) * std::sin(d.azimuth),
                           std::sin(d.altitude));
  }
  return {std::atan2(sum.y(), sum.x()), std::atan2(sum.z(), sum.head<2>().norm())};
}

// Sums of the products of both rays' deviations, for the correlations.
struct Products {
  Eigen::Vector2d both = Eigen::Vector2d::Zero(), first = Eigen::Vector2d::Zero(), second = Eigen::Vector2d::Zero();
  void add(const Angles& off) {
    both += off.head<2>().cwiseProduct(off.tail<2>());
    first += off.head<2>().cwiseAbs2();
    second += off.tail<2>().cwiseAbs2();
  }
  double correlation(int angle) const { return both[angle] / std::sqrt(first[angle] * second[angle]); }
};

[[noreturn]] void refuse(const std::string& target, const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input, "the target '" + base::printable(target) + "' " + why);
}

void fitTarget(const std::string& target, const std::vector<const PointingSample*>& samples, PointingFit& fit,
               Products& products) {
  if (samples.size() < 2) refuse(target, "has one frame only: its errors have no spread");
  Moments all;
  std::map<std::string, Moments> by_person;
  for (const auto* sample : samples) {
    all.add(anglesOf(*sample));
    by_person[sample->person].add(anglesOf(*sample));
  }
  const Angles mean = all.mean();
  Angles squares = Angles::Zero(), within = Angles::Zero(), between = Angles::Zero();
  for (const auto* sample : samples) {
    const Angles off = anglesOf(*sample) - mean;
    squares += off.cwiseAbs2();
    within += (anglesOf(*sample) - by_person.at(sample->person).mean()).cwiseAbs2();
    products.add(off);
  }
  for (const auto& [person, moments] : by_person) between += (moments.mean() - mean).cwiseAbs2();
  const double frames = static_cast<double>(samples.size()), people = static_cast<double>(by_person.size());
  const Angles sigma = (squares / (frames - 1)).cwiseSqrt();
  if (!(sigma.minCoeff() > 0)) refuse(target, "has the same errors in each frame: is the log one frame, repeated?");
  const Angles error = people > 1 ? Angles((between / (people - 1) / people).cwiseSqrt()) : Angles(Angles::Zero());
  const Angles spread = frames > people ? Angles((within / (frames - people)).cwiseSqrt()) : Angles(Angles::Zero());
  fit.model.rows.push_back({target, meanDirection(samples), rayErrors(mean, sigma, 0), rayErrors(mean, sigma, 2)});
  fit.targets.push_back(
      {target, by_person.size(), samples.size(), rayErrors(error, spread, 0), rayErrors(error, spread, 2)});
}

}  // namespace

PointingFit fitPointing(const std::vector<PointingSample>& samples) {
  if (samples.empty())
    throw base::Error(base::ExitCode::unreadable_input, "nobody points at any target: there is nothing to calibrate");
  std::map<std::string, std::vector<const PointingSample*>> by_target;
  for (const PointingSample& sample : samples) by_target[sample.target].push_back(&sample);
  PointingFit fit;
  Products products;
  for (const auto& [target, of_target] : by_target) fitTarget(target, of_target, fit, products);
  fit.model.theta_correlation = products.correlation(0);
  fit.model.psi_correlation = products.correlation(1);
  return fit;
}

}  // namespace omnimapper::interaction
