#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <algorithm>
#include <cmath>

#include "Bundle.h"
#include "Determined.h"

namespace omnimapper::calibration::bundle_test {
namespace {

constexpr double kDegree = base::option_text::kRadiansPerDegree;

geometry::Se3 motion(double x, double y, double z, double a, double b, double c) {
  geometry::Vector6d delta;
  delta << x, y, z, a, b, c;
  return plus(geometry::Se3(), delta);
}

/// Simulated measurements (no images) of corners on the walls of a room of 4 x 3 x 5 m, by a camera that turns and
/// moves in it.
class Room {
 public:
  explicit Room(bool is_registered) {
    truth.is_registered = is_registered;
    truth.width = 640;
    truth.height = 480;
    truth.picture = {520, 522, 318, 244, 0.12, -0.2, 0.001, -0.001, 0.05};
    truth.depth = is_registered ? truth.picture : Intrinsics{570, 572, 322, 238};
    if (!is_registered) truth.depth_from_picture = motion(0.025, 0.002, -0.001, 0.01, -0.005, 0.008);
    truth.depth_scale = is_registered ? 1 : 1.02;
  }

  DepthCamera truth;
  std::vector<CalibrationView> views;
  std::vector<geometry::Se3> picture_from_world;
  std::vector<Eigen::Vector3d> points;
  std::vector<Measurement> measurements;
  std::vector<MetricSpan> spans;

  void see(int view_count, double pixel_noise, double turn = 1) {
    testing::Dice dice(7);
    for (int i = 0; i < 240; ++i) {
      const int axis = i % 3, side = (i / 3) % 2;
      Eigen::Vector3d p;
      for (int k = 0; k < 3; ++k) p[k] = dice.uniform(-half_[k], half_[k]);
      p[axis] = side == 0 ? half_[axis] : -half_[axis];
      points.push_back(p);
    }
    for (int v = 0; v < view_count; ++v) {
      const double t = 0.7 * v;
      const auto world_from_picture =
          motion(0.5 * std::sin(t), 0.3 * std::sin(1.3 * t), 0.6 * std::cos(0.6 * t), turn * 0.3 * std::sin(0.9 * t),
                 turn * 0.6 * std::sin(0.5 * t), turn * 0.5 * std::sin(0.33 * t));
      picture_from_world.push_back(inverse(world_from_picture));
      views.emplace_back();
      views.back().depth_height = truth.height;
      for (std::size_t track = 0; track < points.size(); ++track) seeOne(track, pixel_noise, dice);
    }
    for (std::size_t i = 0; i + 1 < views.size(); ++i) {
      const double distance =
          (inverse(picture_from_world[i]).translation - inverse(picture_from_world[i + 1]).translation).norm();
      if (distance > 0.2) spans.push_back({i, i + 1, distance, 0.005, 0});
    }
  }

  BundleInput input(const DepthCamera& log) const {
    BundleInput input{views, measurements, spans, log, std::vector<bool>(views.size(), false), {}};
    input.are_held[0] = true;
    return input;
  }
  Estimate start(const DepthCamera& log) const {
    Estimate estimate{log, picture_from_world, points, {}};
    testing::Dice dice(3);
    for (auto& pose : estimate.picture_from_world)
      if (&pose != &estimate.picture_from_world.front())
        pose = plus(pose, geometry::Vector6d::NullaryExpr([&] { return dice.normal(0.003); }));
    for (auto& point : estimate.points)
      point += Eigen::Vector3d(dice.normal(0.01), dice.normal(0.01), dice.normal(0.01));
    return estimate;
  }

 private:
  // Adds a measurement with the exact plane that the depth camera sees there, which is the wall of the point.
  void seeOne(std::size_t track, double pixel_noise, testing::Dice& dice) {
    const auto& view = picture_from_world.back();
    const Eigen::Vector3d p = view * points[track];
    if (p.z() < 0.3) return;
    const Eigen::Vector2d place = project(truth.picture.data(), p);
    if (std::abs(p.x() / p.z()) > 0.62 || std::abs(p.y() / p.z()) > 0.47) return;
    const int axis = static_cast<int>(track % 3), side = static_cast<int>(track / 3) % 2;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    normal[axis] = side == 0 ? 1 : -1;
    const auto depth_from_world = truth.depth_from_picture * view;
    const Eigen::Vector3d n = depth_from_world.rotation * normal;
    const double distance = half_[axis] + n.dot(depth_from_world.translation);
    if (distance < 0.2) return;
    const auto& camera = truth.depthCamera();
    const auto inverse_at = [&](const Eigen::Vector2d& pixel) {
      return truth.depth_scale * n.dot(rayThrough(camera, pixel)) / distance;
    };
    const Eigen::Vector2d seen = project(camera.data(), Eigen::Vector3d(truth.depth_from_picture * p));
    const Eigen::Vector2d around(std::round(seen.x()), std::round(seen.y()));
    LocalPlane plane{around, inverse_at(around) + dice.normal(0.001), Eigen::Vector2d::Zero(), 0.001};
    for (int k = 0; k < 2; ++k)
      plane.slope[k] =
          0.5 * (inverse_at(around + Eigen::Vector2d::Unit(k)) - inverse_at(around - Eigen::Vector2d::Unit(k)));
    const Eigen::Vector2d noise(dice.normal(pixel_noise), dice.normal(pixel_noise));
    measurements.push_back({track, views.size() - 1, place + noise, pixel_noise, plane});
  }

  double half_[3] = {2, 1.5, 2.5};
};

void expectTruth(const Adjusted& adjusted, const DepthCamera& truth) {
  const auto& camera = adjusted.estimate.camera;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(camera.picture[i], truth.picture[i], 1.5) << i;
  for (std::size_t i = 4; i < 9; ++i) EXPECT_NEAR(camera.picture[i], truth.picture[i], 0.06) << i;
  // The errors agree with their standard deviations.
  for (const auto& one : adjusted.parameters) {
    if (one.group == Group::focal) {
      EXPECT_NEAR(one.value, truth.picture[static_cast<std::size_t>(one.index)], 4 * one.sigma);
      EXPECT_LT(one.sigma, 1);
    }
  }
}

TEST(Bundle, FindsOneCameraThatTheLogHasWrong) {
  Room room(true);
  room.see(20, 0.2);
  DepthCamera log = room.truth;
  log.picture = {530, 532, 323, 239};  // 2 % and 5 px off, and without lens distortion
  log.depth = log.picture;
  const auto adjusted = adjust(room.input(log), room.start(log), {Group::focal, Group::centre, Group::lens});
  expectTruth(adjusted, room.truth);
}

TEST(Bundle, FindsTwoCamerasTheirPlaceAndTheScaleWhereMetresAreMeasured) {
  Room room(false);
  room.see(20, 0.2);
  DepthCamera log = room.truth;
  log.picture = {530, 512, 323, 239};
  log.depth = {582, 560, 327, 243};
  log.depth_from_picture =
      log.depth_from_picture * motion(0.005, -0.005, 0.005, 0.5 * kDegree, -0.5 * kDegree, 0.5 * kDegree);
  log.depth_scale = 1;
  const auto adjusted = adjust(room.input(log), room.start(log),
                               {Group::focal, Group::centre, Group::lens, Group::depth_focal, Group::depth_centre,
                                Group::place, Group::turn, Group::scale});
  expectTruth(adjusted, room.truth);
  const auto& camera = adjusted.estimate.camera;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(camera.depth[i], room.truth.depth[i], 2.5) << i;
  const geometry::Vector6d off = minus(camera.depth_from_picture, room.truth.depth_from_picture);
  EXPECT_LT(off.head<3>().norm(), 0.004);
  EXPECT_LT(off.tail<3>().norm(), 0.25 * kDegree);
  EXPECT_NEAR(camera.depth_scale, room.truth.depth_scale, 0.003);
  for (const auto& one : adjusted.parameters) EXPECT_LT(one.sigma, one.prior_sigma);
}

TEST(Bundle, WithoutMetresTheScaleOfTheDepthsIsOpen) {
  Room room(true);
  room.see(20, 0.3);
  room.spans.clear();
  const auto adjusted = adjust(room.input(room.truth), room.start(room.truth), {Group::focal, Group::scale});
  EXPECT_GT(undetermined(Group::scale, adjusted), 1) << "a larger scale and a longer distance look the same";
  EXPECT_LT(undetermined(Group::focal, adjusted), 1);
}

TEST(Bundle, TheScaleIsKnownNoBetterThanThatOfTheWheels) {
  Room room(true);
  room.see(20, 0.2);
  for (auto& span : room.spans) span.common_sigma = 0.01;
  const auto adjusted = adjust(room.input(room.truth), room.start(room.truth), {Group::scale});
  ASSERT_EQ(adjusted.parameters.size(), 1U);
  EXPECT_GE(adjusted.parameters.front().sigma, 0.01);
}

TEST(Bundle, ALensOfWhichOnlyTheMiddleIsSeenIsNotDetermined) {
  Room room(true);
  room.see(20, 0.3);
  const auto only_middle = [&](const Measurement& one) { return (one.pixel - Eigen::Vector2d(320, 240)).norm() > 60; };
  auto& all = room.measurements;
  all.erase(std::remove_if(all.begin(), all.end(), only_middle), all.end());
  const auto adjusted = adjust(room.input(room.truth), room.start(room.truth), {Group::focal, Group::lens});
  EXPECT_GT(undetermined(Group::lens, adjusted), 1);
}

TEST(Bundle, TheSameInputGivesTheSameBits) {
  Room room(true);
  room.see(12, 0.3);
  const auto once = adjust(room.input(room.truth), room.start(room.truth), {Group::focal, Group::lens});
  const auto again = adjust(room.input(room.truth), room.start(room.truth), {Group::focal, Group::lens});
  EXPECT_EQ(once.estimate.camera.picture, again.estimate.camera.picture);
  EXPECT_EQ(once.cost, again.cost);
}

TEST(Bundle, StopsWhenItIsAskedTo) {
  Room room(true);
  room.see(12, 0.3);
  auto input = room.input(room.truth);
  input.stop = [] { return true; };
  EXPECT_THROW(adjust(input, room.start(room.truth), {Group::focal}), base::Error);
}

}  // namespace
}  // namespace omnimapper::calibration::bundle_test
