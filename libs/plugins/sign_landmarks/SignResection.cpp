#include "SignResection.h"

#include <omnimapper/geometry/SymmetricEigen.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

namespace omnimapper::plugins {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Se3;

namespace {

constexpr double kFits = 3;  // [sigma]

Se3 levelPose(const Vector3d& x_y_yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(x_y_yaw[2], Vector3d::UnitZ())), {x_y_yaw[0], x_y_yaw[1], 0}};
}

// Error of the direction [sigma]. `place`: x, y, yaw of the session in the map.
Vector2d missOf(const KnownSignBearing& measurement, const Vector3d& place) {
  const Vector3d in_base = geometry::inverse(levelPose(place) * measurement.session_from_base) * measurement.in_map;
  return measurement.seen.angleTo(in_base - measurement.seen.camera(), nullptr) / measurement.sigma;
}

double yawOf(const Se3& pose) {
  const Vector3d ahead = pose.rotation * Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

// x, y, yaw of the session if the sign is seen from `distance` [m] straight in front of it.
Vector3d placeBefore(const KnownSignBearing& measurement, double distance) {
  const Se3 base = baseBefore(measurement, distance);
  const Vector3d& in_session = measurement.session_from_base.translation;
  const double yaw = yawOf(base) - yawOf(measurement.session_from_base);
  const Vector3d shift = base.translation - Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * in_session;
  return {shift.x(), shift.y(), yaw};
}

// Starts in front of each sign, by its last measurement, at several distances and from several sides: normals are known
// only roughly, and two signs that are seen over a short distance travelled fit more than one place.
std::vector<Vector3d> startsOf(const std::vector<KnownSignBearing>& measurements) {
  std::vector<Vector3d> starts;
  std::set<base::LandmarkId> done;
  for (auto seen = measurements.rbegin(); seen != measurements.rend(); ++seen) {
    if (!done.insert(seen->sign).second) continue;
    for (const double turn : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      KnownSignBearing turned = *seen;
      turned.normal = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * seen->normal;
      for (const double distance : {1.2, 2.5, 5.0}) starts.push_back(placeBefore(turned, distance));
    }
  }
  return starts;
}

struct Descent {
  std::vector<Vector3d> places;  // after each iteration; the last is the result
  Matrix3d information;          // at the result
};

// Gauss-Newton with a Cauchy loss, so that a sign that was moved has little influence.
Descent descended(const std::vector<KnownSignBearing>& measurements, const Vector3d& start) {
  constexpr int kRounds = 30;
  constexpr double kStep = 1e-6, kDamping = 1e-3;
  constexpr double kLongestStep = 2, kLargestTurn = 0.3;  // [m] [rad]
  Descent descent{{start}, Matrix3d::Zero()};
  for (int round = 0; round < kRounds; ++round) {
    const Vector3d place = descent.places.back();
    Matrix3d information = kDamping * Matrix3d::Identity();
    Vector3d gradient = Vector3d::Zero();
    for (const auto& measurement : measurements) {
      const Vector2d miss = missOf(measurement, place);
      Eigen::Matrix<double, 2, 3> jacobian;
      for (int i = 0; i < 3; ++i)
        jacobian.col(i) = (missOf(measurement, place + kStep * Vector3d::Unit(i)) - miss) / kStep;
      const double weight = 1 / (1 + miss.squaredNorm() / (kFits * kFits));
      information += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() * miss;
    }
    Vector3d step = information.ldlt().solve(gradient);
    step *= std::min({1.0, kLongestStep / step.head<2>().norm(), kLargestTurn / std::abs(step[2])});
    if (!step.allFinite()) break;
    descent.places.push_back(place - step);
    descent.information = information;
  }
  return descent;
}

struct Candidate {
  Vector3d place;
  Vector3d base;  // position at the newest measurement, in the map
  std::size_t fitting = 0;
  double chi2 = 0;  // of the measurements that fit
  std::set<base::LandmarkId> signs = {};
  bool is_numbered = false;        // at least one of these signs has a number
  Eigen::AlignedBox3d bases = {};  // from which these signs are seen, in the session

  bool isBetterThan(const Candidate& other) const {
    return fitting != other.fitting ? fitting > other.fitting : chi2 < other.chi2;
  }
  // Whether it is at another place and hardly less likely.
  bool isRivalOf(const Candidate& best) const {
    constexpr double kElsewhere = 1, kTurned = 0.3;  // [m] [rad]
    constexpr double kLikely = 11.3;                 // chi-square of three unknowns, 99 %
    const bool is_elsewhere = (base - best.base).norm() > kElsewhere ||
                              std::abs(std::remainder(place[2] - best.place[2], 2 * M_PI)) > kTurned;
    const bool fits_as_many = fitting >= best.fitting && chi2 < best.chi2 + kLikely;
    return is_elsewhere && (fits_as_many || (fitting + 1 == best.fitting && chi2 < best.chi2));
  }
};

Candidate candidateAt(const std::vector<KnownSignBearing>& measurements, const Vector3d& place) {
  Candidate candidate{place, levelPose(place) * measurements.back().session_from_base.translation};
  for (const auto& measurement : measurements) {
    const double miss = missOf(measurement, place).norm();
    if (!(miss <= kFits)) continue;
    ++candidate.fitting;
    candidate.chi2 += miss * miss;
    candidate.signs.insert(measurement.sign);
    candidate.bases.extend(measurement.session_from_base.translation);
    candidate.is_numbered = candidate.is_numbered || measurement.is_numbered;
  }
  return candidate;
}

}  // namespace

Se3 baseBefore(const KnownSignBearing& measurement, double distance) {
  const Vector3d& seen = measurement.seen.direction();
  const double yaw = std::atan2(-measurement.normal.y(), -measurement.normal.x()) - std::atan2(seen.y(), seen.x());
  const Eigen::AngleAxisd turn(yaw, Vector3d::UnitZ());
  Vector3d base = measurement.in_map + distance * measurement.normal - turn * measurement.seen.camera();
  base.z() = measurement.session_from_base.translation.z();
  return {Eigen::Quaterniond(turn), base};
}

std::optional<SessionFit> resection(const std::vector<KnownSignBearing>& measurements) {
  constexpr std::size_t kFewest = 4, kSigns = 2;
  constexpr double kMostSigma = 0.35, kLeastBase = 0.5;  // [m]
  if (measurements.size() < kFewest) return std::nullopt;
  // The session is rotated about the newest base: about a distant origin, even a small rotation would move it far.
  const Vector3d& newest = measurements.back().session_from_base.translation;
  const Vector3d pivot(newest.x(), newest.y(), 0);
  auto centred = measurements;
  for (auto& measurement : centred) measurement.session_from_base.translation -= pivot;
  std::vector<Descent> descents;
  for (const auto& start : startsOf(centred)) descents.push_back(descended(centred, start));
  std::optional<Candidate> best;
  const Descent* to_best = nullptr;
  for (const auto& descent : descents) {
    const Candidate candidate = candidateAt(centred, descent.places.back());
    if (best && !candidate.isBetterThan(*best)) continue;
    best = candidate;
    to_best = &descent;
  }
  if (best->fitting < kFewest || best->signs.size() < kSigns || !best->is_numbered ||
      best->bases.diagonal().norm() < kLeastBase || 3 * best->fitting < 2 * centred.size())
    return std::nullopt;
  // Two signs that are seen over a short distance travelled fit a whole arc of places nearly equally well, which the
  // covariance at one of them does not show.
  for (const auto& descent : descents)
    for (const auto& place : descent.places)
      if (const Candidate other = candidateAt(centred, place); other.isRivalOf(*best)) return std::nullopt;
  const Matrix3d covariance = to_best->information.inverse();
  const double position_sigma =
      std::sqrt(std::max(0.0, geometry::eigenvaluesOf<2>(covariance.topLeftCorner<2, 2>())[1]));
  if (!(position_sigma <= kMostSigma)) return std::nullopt;
  const Se3 pivoted{Eigen::Quaterniond::Identity(), -pivot};
  return SessionFit{levelPose(best->place) * pivoted, position_sigma, std::sqrt(covariance(2, 2)), best->fitting};
}

}  // namespace omnimapper::plugins
