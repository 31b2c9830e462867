#include "SignResection.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
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

// [sigma] of the direction; `place`: x, y, yaw of the session in the map.
Vector2d missOf(const SeenKnownSign& sighting, const Vector3d& place) {
  const Vector3d in_base = geometry::inverse(levelPose(place) * sighting.session_from_base) * sighting.in_map;
  return sighting.seen.angleTo(in_base - sighting.seen.camera(), nullptr) / sighting.sigma;
}

double yawOf(const Se3& pose) {
  const Vector3d ahead = pose.rotation * Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

// x, y, yaw of the session if the sign is seen from `distance` [m] straight before it.
Vector3d placeBefore(const SeenKnownSign& sighting, double distance) {
  const Se3 base = baseBefore(sighting, distance);
  const Vector3d& in_session = sighting.session_from_base.translation;
  const double yaw = yawOf(base) - yawOf(sighting.session_from_base);
  const Vector3d shift = base.translation - Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * in_session;
  return {shift.x(), shift.y(), yaw};
}

struct Descent {
  Vector3d place;
  Matrix3d information;
};

// Gauss-Newton with a Cauchy loss, so that one sign that was moved does not count for much.
Descent descended(const std::vector<SeenKnownSign>& sightings, Vector3d place) {
  constexpr int kRounds = 20;
  constexpr double kStep = 1e-6, kDamping = 1e-3;
  Matrix3d information = Matrix3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    information = kDamping * Matrix3d::Identity();
    Vector3d gradient = Vector3d::Zero();
    for (const auto& sighting : sightings) {
      const Vector2d miss = missOf(sighting, place);
      Eigen::Matrix<double, 2, 3> jacobian;
      for (int i = 0; i < 3; ++i)
        jacobian.col(i) = (missOf(sighting, place + kStep * Vector3d::Unit(i)) - miss) / kStep;
      const double weight = 1 / (1 + miss.squaredNorm() / (kFits * kFits));
      information += weight * jacobian.transpose() * jacobian;
      gradient += weight * jacobian.transpose() * miss;
    }
    place -= information.ldlt().solve(gradient);
    if (!place.allFinite()) return {Vector3d::Zero(), Matrix3d::Zero()};
  }
  return {place, information};
}

struct Candidate {
  Vector3d place;
  Matrix3d information;
  Vector3d base;  // of the newest sighting, in the map
  std::size_t fitting = 0;
  std::set<std::size_t> signs = {};
  bool is_numbered = false;  // one of them at least
};

Candidate candidateAt(const std::vector<SeenKnownSign>& sightings, const Descent& descent) {
  Candidate candidate{descent.place, descent.information,
                      levelPose(descent.place) * sightings.back().session_from_base.translation};
  for (const auto& sighting : sightings) {
    if (missOf(sighting, descent.place).norm() > kFits) continue;
    ++candidate.fitting;
    candidate.signs.insert(sighting.sign);
    candidate.is_numbered = candidate.is_numbered || sighting.is_numbered;
  }
  return candidate;
}

bool isOther(const Candidate& a, const Candidate& b) {
  constexpr double kElsewhere = 1, kTurned = 0.3;  // [m] [rad]
  return (a.base - b.base).norm() > kElsewhere || std::abs(std::remainder(a.place[2] - b.place[2], 2 * M_PI)) > kTurned;
}

}  // namespace

Se3 baseBefore(const SeenKnownSign& sighting, double distance) {
  const Vector3d& seen = sighting.seen.direction();
  const double yaw = std::atan2(-sighting.normal.y(), -sighting.normal.x()) - std::atan2(seen.y(), seen.x());
  const Eigen::AngleAxisd turn(yaw, Vector3d::UnitZ());
  Vector3d base = sighting.in_map + distance * sighting.normal - turn * sighting.seen.camera();
  base.z() = sighting.session_from_base.translation.z();
  return {Eigen::Quaterniond(turn), base};
}

std::optional<SessionFit> resection(const std::vector<SeenKnownSign>& sightings) {
  constexpr std::size_t kFewest = 4, kSigns = 2;
  constexpr double kMostSigma = 0.7;  // [m]
  if (sightings.size() < kFewest) return std::nullopt;
  std::vector<Candidate> candidates;
  for (const auto& sighting : sightings)
    for (const double distance : {1.2, 2.5, 5.0})
      candidates.push_back(candidateAt(sightings, descended(sightings, placeBefore(sighting, distance))));
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [](const auto& a, const auto& b) { return a.fitting < b.fitting; });
  if (best->fitting < kFewest || best->signs.size() < kSigns || !best->is_numbered ||
      3 * best->fitting < 2 * sightings.size())
    return std::nullopt;
  for (const auto& other : candidates)
    if (other.fitting == best->fitting && isOther(other, *best)) return std::nullopt;
  // The session's origin may be far away: the position that counts is that of the newest base.
  const Vector2d arm = best->base.head<2>() - best->place.head<2>();
  const Matrix3d covariance = best->information.inverse();
  Eigen::Matrix<double, 2, 3> by_place;
  by_place << 1, 0, -arm.y(), 0, 1, arm.x();
  const Eigen::Matrix2d of_base = by_place * covariance * by_place.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(of_base, Eigen::EigenvaluesOnly);
  const double position_sigma = std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
  if (!(position_sigma <= kMostSigma)) return std::nullopt;
  return SessionFit{levelPose(best->place), position_sigma, std::sqrt(covariance(2, 2)), best->fitting};
}

}  // namespace omnimapper::plugins
