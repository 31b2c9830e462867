#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/map/DenseTrajectory.h>

#include <random>

namespace map_test {
namespace {

using mrpt::poses::CPose3D;
using namespace omnimapper;

base::Stamp at(double seconds) {
  return base::stampFromUnix(1e9 + seconds);
}

map::KeyFrame keyFrame(std::uint32_t index, double seconds, const CPose3D& map_from_base) {
  map::KeyFrame frame;
  frame.id = {0, index};
  frame.stamp = at(seconds);
  frame.map_from_base = map_from_base;
  return frame;
}

void expectNear(const CPose3D& a, const CPose3D& b, double tolerance) {
  const geometry::Vector6d difference = geometry::minus(geometry::fromMrpt(a), geometry::fromMrpt(b));
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), tolerance) << a.asString() << " is not " << b.asString();
}

map::Map mapOf(const std::vector<map::KeyFrame>& frames) {
  map::Map map;
  for (const auto& frame : frames) map.key_frames.insert(frame);
  return map;
}

TEST(Map, findsAKeyFrameByIdWhateverTheOrderOfIds) {
  const auto map = mapOf({keyFrame(0, 0, {}), keyFrame(1, 2, {}), keyFrame(2, 3, {}), keyFrame(3, 1, {})});
  for (std::uint32_t index : {0u, 1u, 2u, 3u}) EXPECT_EQ(map.keyFrame({0, index}).id.index, index);
}

TEST(Map, aKeyFrameThatIsNotThereIsAnErrorNamingIt) {
  const map::Map map = mapOf({keyFrame(0, 0, {})});
  try {
    map.keyFrame({2, 7});
    FAIL() << "no error";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::internal);
    EXPECT_NE(std::string(error.what()).find("2:7"), std::string::npos) << error.what();
  }
}

TEST(DenseTrajectory, spreadsADriftEvenlyInTime) {
  // The source measured 1 m straight ahead in 1 s, with frames at 0.25 s and 0.5 s; in the graph it is 1.2 m ahead and
  // 0.4 m to the left.
  map::KeyFrame first = keyFrame(0, 0, {});
  first.dependents = {{at(0.25), CPose3D(0.25, 0, 0, 0, 0, 0)}, {at(0.5), CPose3D(0.5, 0, 0, 0, 0, 0)}};
  first.keyframe_from_next = CPose3D(1, 0, 0, 0, 0, 0);
  const auto path = map::denseTrajectory(mapOf({first, keyFrame(1, 1, CPose3D(1.2, 0.4, 0, 0, 0, 0))}));
  ASSERT_EQ(path.size(), 4u);
  expectNear(path[0].map_from_base, {}, 1e-12);
  expectNear(path[1].map_from_base, CPose3D(0.3, 0.1, 0, 0, 0, 0), 1e-12);
  expectNear(path[2].map_from_base, CPose3D(0.6, 0.2, 0, 0, 0, 0), 1e-12);
  expectNear(path[3].map_from_base, CPose3D(1.2, 0.4, 0, 0, 0, 0), 1e-12);
  EXPECT_EQ(path[2].stamp, at(0.5));
}

TEST(NewestPose, isThatOfTheLastFrameBehindTheLastKeyFrame) {
  auto newest = keyFrame(1, 1, CPose3D(2, 1, 0, M_PI / 2, 0, 0));
  EXPECT_NEAR(map::newestPose(mapOf({newest})).x(), 2, 1e-12);
  newest.dependents = {{at(1.1), CPose3D(0.1, 0, 0, 0, 0, 0)}, {at(1.2), CPose3D(0.3, 0, 0, 0, 0, 0)}};
  const auto pose = map::newestPose(mapOf({keyFrame(0, 0, CPose3D()), newest}));
  EXPECT_NEAR(pose.x(), 2, 1e-12);
  EXPECT_NEAR(pose.y(), 1.3, 1e-12);
}

TEST(DenseTrajectory, aDriftKeepsItsDirectionInTheMapWhileTheRobotTurns) {
  // The robot turns a half circle on the spot while the optimized end lies 0.2 m along the map's x.
  map::KeyFrame first = keyFrame(0, 0, {});
  first.dependents = {{at(0.5), CPose3D(0, 0, 0, M_PI / 2, 0, 0)}};
  first.keyframe_from_next = CPose3D(0, 0, 0, M_PI, 0, 0);
  const auto path = map::denseTrajectory(mapOf({first, keyFrame(1, 1, CPose3D(0.2, 0, 0, M_PI, 0, 0))}));
  expectNear(path[1].map_from_base, CPose3D(0.1, 0, 0, M_PI / 2, 0, 0), 1e-12);
}

TEST(DenseTrajectory, spreadsATurnEvenlyInTime) {
  map::KeyFrame first = keyFrame(0, 0, {});
  first.dependents = {{at(1), CPose3D(0, 0, 0, 0.1, 0, 0)}};
  first.keyframe_from_next = CPose3D(0, 0, 0, 0.4, 0, 0);
  const auto path = map::denseTrajectory(mapOf({first, keyFrame(1, 4, CPose3D(0, 0, 0, 0.8, 0, 0))}));
  expectNear(path[1].map_from_base, CPose3D(0, 0, 0, 0.2, 0, 0), 1e-12);
}

TEST(DenseTrajectory, aDependentFrameAtTheEndIsTheNextKeyFrameInSpace) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto pose = [&] {
    return CPose3D(any(random), any(random), any(random), 3 * any(random), any(random), any(random));
  };
  for (int trial = 0; trial < 100; ++trial) {
    map::KeyFrame first = keyFrame(0, 0, pose());
    first.keyframe_from_next = pose();
    first.dependents = {{at(0), CPose3D()}, {at(2), first.keyframe_from_next}};
    const map::KeyFrame second = keyFrame(1, 2, pose());
    const auto path = map::denseTrajectory(mapOf({first, second}));
    expectNear(path[1].map_from_base, first.map_from_base, 1e-9);
    expectNear(path[2].map_from_base, second.map_from_base, 1e-9);
  }
}

TEST(DenseTrajectory, withoutDisagreementItIsTheMeasuredPath) {
  map::KeyFrame first = keyFrame(0, 0, CPose3D(1, 2, 3, 0.4, 0.1, -0.2));
  first.dependents = {{at(0.3), CPose3D(0.1, 0.2, 0, 0.3, 0, 0)}};
  first.keyframe_from_next = CPose3D(0.5, 0.1, 0.2, 0.6, 0.1, 0);
  const auto path =
      map::denseTrajectory(mapOf({first, keyFrame(1, 1, first.map_from_base + first.keyframe_from_next)}));
  expectNear(path[1].map_from_base, first.map_from_base + first.dependents[0].keyframe_from_base, 1e-12);
}

TEST(DenseTrajectory, afterTheNewestKeyFrameTheSourceAloneSpeaks) {
  map::KeyFrame only = keyFrame(0, 0, CPose3D(1, 0, 0, M_PI / 2, 0, 0));
  only.dependents = {{at(1), CPose3D(2, 0, 0, 0, 0, 0)}};
  const auto path = map::denseTrajectory(mapOf({only}));
  ASSERT_EQ(path.size(), 2u);
  expectNear(path[1].map_from_base, CPose3D(1, 2, 0, M_PI / 2, 0, 0), 1e-12);
  EXPECT_TRUE(map::denseTrajectory({}).empty());
}

}  // namespace
}  // namespace map_test
