#include <gtest/gtest.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <cmath>

#include "object_landmarks/ObjectModel.h"

namespace omnimapper::plugins::object_model_test {
namespace {

using Eigen::Vector3d;

// The surface of a box along the axes of the base, a point every centimetre.
ObjectPoints surfaceOf(const Vector3d& middle, const Vector3d& size) {
  ObjectPoints points;
  for (double x = 0; x <= size.x() + 1e-9; x += 0.01)
    for (double y = 0; y <= size.y() + 1e-9; y += 0.01)
      for (double z = 0; z <= size.z() + 1e-9; z += 0.01) {
        const bool is_inner =
            x > 1e-9 && x < size.x() - 1e-9 && y > 1e-9 && y < size.y() - 1e-9 && z > 1e-9 && z < size.z() - 1e-9;
        if (!is_inner) points.push_back((middle - 0.5 * size + Vector3d(x, y, z)).cast<float>());
      }
  return points;
}

ObjectView viewFrom(base::KeyFrameId frame, ObjectPoints points, double distance) {
  ObjectView view;
  view.frame = frame;
  view.distance = distance;
  view.points = std::move(points);
  return view;
}

const ModelLimits kLimits;

TEST(BoxAround, FindsATurnedBox) {
  const Vector3d size(0.2, 0.12, 0.3);
  ObjectPoints points = surfaceOf(Vector3d::Zero(), size);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.4, Vector3d::UnitZ()));
  for (auto& point : points) point = (turn * point.cast<double>() + Vector3d(3, -2, 1)).cast<float>();
  const map::Box box = boxAround(points, Vector3d::UnitZ());
  EXPECT_LT((box.middle - Vector3d(3, -2, 1)).norm(), 0.003);
  EXPECT_NEAR(std::max(box.size.x(), box.size.y()), 0.2, 0.01);
  EXPECT_NEAR(std::min(box.size.x(), box.size.y()), 0.12, 0.01);
  EXPECT_NEAR(box.size.z(), 0.3, 0.001);
}

TEST(BoxAround, OfOnePointHasASize) {
  const map::Box box = boxAround({Eigen::Vector3f(1, 2, 3)}, Vector3d::UnitX());
  EXPECT_LT((box.middle - Vector3d(1, 2, 3)).norm(), 1e-6);
  EXPECT_GT(box.size.minCoeff(), 0);
}

TEST(ObjectModel, FollowsItsKeyFramesWhenALoopCloses) {
  testing::HandMadeRun run;
  const auto first = run.addFrame({}).id, second = run.addFrame({1, 0, 0, 0, 0, 0}).id;
  const Vector3d size(0.1, 0.1, 0.1);
  ObjectModel model = ObjectModel().with(viewFrom(first, surfaceOf({2, 0, 1}, size), 1.5), run.map.key_frames, kLimits);
  model = model.with(viewFrom(second, surfaceOf({1, 0.05, 1}, size), 1.5), run.map.key_frames, kLimits);
  const auto before = model.box(run.map.key_frames).value();
  EXPECT_NEAR(before.size.y(), 0.15, 0.01) << "half of the second view is beside the first";
  for (const auto id : {first, second}) {
    auto& pose = run.map.key_frames.edit(id).map_from_base;
    pose = mrpt::poses::CPose3D(0, 0.5, 0, 0, 0, 0) + pose;
  }
  const auto after = model.box(run.map.key_frames).value();
  EXPECT_LT((after.middle - before.middle - Vector3d(0, 0.5, 0)).norm(), 1e-4);
}

TEST(ObjectModel, KeepsTheNearerOfTwoPointsAtOnePlace) {
  testing::HandMadeRun run;
  const auto far = run.addFrame({}).id, near = run.addFrame({1, 0, 0, 0, 0, 0}).id;
  const Vector3d size(0.1, 0.1, 0.1);
  // The farther view is off by a centimetre, less than the blur of 3 m.
  ObjectModel model = ObjectModel().with(viewFrom(far, surfaceOf({3.01, 0, 1}, size), 3), run.map.key_frames, kLimits);
  model = model.with(viewFrom(near, surfaceOf({2, 0, 1}, size), 1), run.map.key_frames, kLimits);
  std::size_t of_near = 0;
  for (const auto& view : model.views())
    if (view.frame == near) of_near = view.points.size();
  EXPECT_EQ(of_near, surfaceOf({2, 0, 1}, size).size());
  EXPECT_LT(static_cast<double>(model.size() - of_near), 0.3 * static_cast<double>(of_near));
}

TEST(ObjectModel, StaysWithinItsLimits) {
  testing::HandMadeRun run;
  ModelLimits limits;
  limits.max_points = 500;
  limits.max_views = 5;
  ObjectModel model;
  for (int i = 0; i < 20; ++i) {
    const auto frame = run.addFrame({0.01 * i, 0, 0, 0, 0, 0}).id;
    model = model.with(viewFrom(frame, surfaceOf({2, 0.05 * i, 1}, {0.1, 0.1, 0.1}), 1 + 0.1 * i), run.map.key_frames,
                       limits);
    EXPECT_LE(model.size(), 500U);
    EXPECT_LE(model.views().size(), 5U);
  }
  EXPECT_GT(model.size(), 400U);
  for (const auto& view : model.views()) EXPECT_LT(view.distance, 1.5) << "the nearest stay";
}

TEST(ObjectModel, ReachesDownToItsSurfaceIfOnlyItsFootIsLost) {
  testing::HandMadeRun run;
  const auto frame = run.addFrame({}).id;
  auto view = viewFrom(frame, surfaceOf({1, 0, 0.5}, {0.1, 0.1, 0.2}), 1);
  const auto bottomWith = [&](double foot) {
    view.foot = Vector3d(1.05, 0, foot);
    const auto box = ObjectModel().with(view, run.map.key_frames, kLimits).box(run.map.key_frames).value();
    EXPECT_NEAR(box.middle.z() + 0.5 * box.size.z(), 0.6, 0.001);
    return box.middle.z() - 0.5 * box.size.z();
  };
  EXPECT_NEAR(bottomWith(0.37), 0.37, 0.001);
  EXPECT_NEAR(bottomWith(0.2), 0.4, 0.001) << "it may stand behind something";
}

TEST(ObjectModel, CanBeWithoutSomePoints) {
  testing::HandMadeRun run;
  const auto first = run.addFrame({}).id, second = run.addFrame({1, 0, 0, 0, 0, 0}).id;
  auto coloured = viewFrom(first, {{1, 0, 0}, {2, 0, 0}}, 1);
  coloured.colours = {{1, 1, 1}, {2, 2, 2}};
  const ObjectModel model({coloured, viewFrom(second, {{0.5F, 0, 0}}, 1)});
  const auto rest = model.without([](const Eigen::Vector3f& point) { return point.x() < 1.8F; }, run.map.key_frames);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest.views().size(), 1U) << "a view without points is left out";
  EXPECT_EQ(rest.colours().front(), (obs::Rgb{2, 2, 2}));
}

TEST(ObjectModel, OfSomeKeyFramesHasTheirViewsAlone) {
  testing::HandMadeRun run;
  const auto first = run.addFrame({}).id, second = run.addFrame({1, 0, 0, 0, 0, 0}).id;
  ObjectModel model;
  model = model.with(viewFrom(first, {{1, 0, 0}}, 1), run.map.key_frames, kLimits);
  model = model.with(viewFrom(second, {{1, 0, 0}}, 1), run.map.key_frames, kLimits);
  ASSERT_EQ(model.size(), 2U);
  const auto part = model.seenFrom({second});
  ASSERT_EQ(part.size(), 1U);
  EXPECT_NEAR(part.pointsInMap(run.map.key_frames).front().x(), 2, 1e-6);
  EXPECT_EQ(part.colours().size(), 1U) << "grey where there is none";
}

}  // namespace
}  // namespace omnimapper::plugins::object_model_test
