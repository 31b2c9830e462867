#include "MarkerPose.h"

#include <omnimapper/geometry/Rotation3.h>

#include <Eigen/Cholesky>
#include <opencv2/calib3d.hpp>
#include <vector>

namespace omnimapper::perception::markers {

namespace {

using Eigen::Vector3d;
using geometry::Matrix6d;
using geometry::Se3;
using geometry::Vector6d;
using Matrix86 = Eigen::Matrix<double, 8, 6>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

std::array<Vector3d, 4> cornersOfMarker(double side) {
  const double half = 0.5 * side;
  return {Vector3d(-half, half, 0), Vector3d(half, half, 0), Vector3d(half, -half, 0), Vector3d(-half, -half, 0)};
}

// The marker's pose if it faced the camera.
Se3 facing(const camera::Corners& rays, double side) {
  const Eigen::Vector2d right = 0.5 * (rays[1] - rays[0] + rays[2] - rays[3]);
  const Eigen::Vector2d middle = 0.25 * (rays[0] + rays[1] + rays[2] + rays[3]);
  const Eigen::Vector2d along = right.normalized();
  Eigen::Matrix3d axes;
  axes << along.x(), along.y(), 0, along.y(), -along.x(), 0, 0, 0, -1;
  return {Eigen::Quaterniond(axes), Vector3d(middle.x(), middle.y(), 1) * side / right.norm()};
}

// Initial guesses: OpenCV's two poses, which are wrong if the marker faces the camera almost exactly, and therefore
// also the pose that faces it.
std::vector<Se3> guesses(const camera::Corners& rays, double side) {
  std::vector<cv::Point3d> corners;
  std::vector<cv::Point2d> places;
  for (const auto& corner : cornersOfMarker(side)) corners.emplace_back(corner.x(), corner.y(), corner.z());
  for (const auto& ray : rays) places.emplace_back(ray.x(), ray.y());
  std::vector<cv::Mat> rotations, translations;
  cv::solvePnPGeneric(corners, places, cv::Matx33d::eye(), cv::noArray(), rotations, translations, false,
                      cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<Se3> poses{facing(rays, side)};
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const auto vectorOf = [](const cv::Mat& m) { return Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2)); };
    poses.push_back({geometry::expSo3(vectorOf(rotations[i])), vectorOf(translations[i])});
  }
  return poses;
}

// Reprojection errors of the corners at a pose, and their derivative by a small motion (Se3's tangent).
struct Fit {
  Vector8 off;  // [px]
  Matrix86 by_pose;

  Matrix6d information() const { return by_pose.transpose() * by_pose; }
};

// None if a corner is not in front of the camera.
std::optional<Fit> fitAt(const Se3& pose, const camera::LensModel& lens, const camera::Corners& in_image, double side) {
  constexpr double kNearest = 1e-3;  // relative to the side
  const Eigen::Matrix3d turn = pose.rotation.toRotationMatrix();
  Fit fit;
  int row = 0;
  for (const Vector3d& corner : cornersOfMarker(side)) {
    const Vector3d point = pose * corner;
    if (!point.allFinite() || !(point.z() > kNearest * side)) return std::nullopt;
    const auto seen = lens.project(point);
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << turn, -turn * geometry::skew(corner);
    fit.off.segment<2>(2 * row) = seen.place - in_image[static_cast<std::size_t>(row)];
    fit.by_pose.middleRows<2>(2 * row) = seen.by_point * by_pose;
    ++row;
  }
  if (!fit.off.allFinite() || !fit.by_pose.allFinite()) return std::nullopt;
  return fit;
}

struct Refined {
  Se3 pose;
  Fit fit;
};

// Refines a pose by the Levenberg-Marquardt method.
std::optional<Refined> refined(Se3 pose, const camera::LensModel& lens, const camera::Corners& in_image, double side) {
  constexpr int kSteps = 50;
  constexpr double kSettled = 1e-10;  // relative decrease of the squared error
  constexpr double kMostDamping = 1e6;
  auto fit = fitAt(pose, lens, in_image, side);
  if (!fit) return std::nullopt;
  double damping = 1e-6;
  for (int step = 0; step < kSteps; ++step) {
    Matrix6d damped = fit->information();
    damped.diagonal() *= 1 + damping;
    const Vector6d update = damped.ldlt().solve(fit->by_pose.transpose() * -fit->off);
    if (!update.allFinite()) break;
    const Se3 next = geometry::plus(pose, update);
    const auto there = fitAt(next, lens, in_image, side);
    const double before = fit->off.squaredNorm();
    if (!there || !(there->off.squaredNorm() < before)) {
      damping *= 10;
      if (damping > kMostDamping) break;
      continue;
    }
    pose = next;
    fit = there;
    damping *= 0.1;
    if (before - fit->off.squaredNorm() <= kSettled * before) break;
  }
  return Refined{pose, *fit};
}

}  // namespace

std::optional<MarkerPose> poseOfMarker(const camera::LensModel& lens, const camera::Corners& in_image, double side,
                                       double corner_sigma) {
  const auto rays = lens.raysOf(in_image);
  if (!rays) return std::nullopt;
  std::optional<Refined> best;
  for (const Se3& guess : guesses(*rays, side)) {
    const auto found = refined(guess, lens, in_image, side);
    if (found && (!best || found->fit.off.squaredNorm() < best->fit.off.squaredNorm())) best = found;
  }
  if (!best) return std::nullopt;
  const Eigen::LDLT<Matrix6d> information(best->fit.information());
  if (information.info() != Eigen::Success || !(information.vectorD().minCoeff() > 0)) return std::nullopt;
  const Matrix6d covariance = corner_sigma * corner_sigma * information.solve(Matrix6d::Identity());
  const Eigen::Matrix3d turn = best->pose.rotation.toRotationMatrix();
  return MarkerPose{best->pose, turn * covariance.topLeftCorner<3, 3>() * turn.transpose()};
}

}  // namespace omnimapper::perception::markers
