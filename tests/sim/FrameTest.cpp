#include <camera/Frame.h>
#include <gtest/gtest.h>
#include <omnimapper/geometry/OpticalFrame.h>

#include <cmath>

#include "CameraFixture.h"

namespace frame_test {
namespace {

using namespace omnimapper;
using sim::Frame;
using sim::Pinhole;

const geometry::Se3 kLookingAlongX = geometry::sensorFromOptical();

TEST(Frame, depthsLieOnTheTruePlanes) {
  sim::CameraFixture fixture;
  const geometry::Se3 tilted{Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.1, 0.9, 0.4).normalized())),
                             {3, 0.2, -0.1}};
  fixture.addFacing("wall", sim::SurfaceKind::wall, tilted, 30, 30);
  const sim::Scenes scenes(fixture.world);
  const geometry::Se3 map_from_optical =
      geometry::Se3{Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 3).normalized())),
                    {0.1, 0.2, 0.3}} *
      kLookingAlongX;
  const Frame frame = sim::castFrame(scenes, scenes.at(0), Pinhole::centred(160, 120, 130), map_from_optical);
  const Eigen::Vector3d normal = tilted.rotation * Eigen::Vector3d::UnitX();
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      ASSERT_GT(frame.at(column, row).depth, 0);
      const Eigen::Vector3d point =
          map_from_optical * (frame.at(column, row).depth * frame.camera.through(column, row));
      ASSERT_NEAR(normal.dot(point - tilted.translation), 0, 1e-9) << column << " " << row;
    }
  }
}

TEST(Frame, aWallAheadHasOneDepthAndTheCosineOfItsRays) {
  sim::CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 10, 10);
  const sim::Scenes scenes(fixture.world);
  const Frame frame = sim::castFrame(scenes, scenes.at(0), Pinhole::centred(65, 33, 40), kLookingAlongX);
  EXPECT_NEAR(frame.at(32, 16).cosine, 1, 1e-6);
  EXPECT_NEAR(frame.at(62, 16).cosine, 0.8, 1e-6);  // 30 pixels aside at a focal length of 40: 3, 4, 5
  for (const auto& pixel : frame.pixels) EXPECT_NEAR(pixel.depth, 2, 1e-12);
}

// The point where a ray meets a triangle, computed in doubles; none if it misses.
double meet(const sim::Body& body, const sim::Triangle& triangle, const Eigen::Vector3d& eye,
            const Eigen::Vector3d& along) {
  const geometry::Se3 map_from_body = *body.track.at(0);
  const Eigen::Vector3d a = map_from_body * body.vertices_in_body[triangle.corners[0]],
                        ab = map_from_body * body.vertices_in_body[triangle.corners[1]] - a,
                        ac = map_from_body * body.vertices_in_body[triangle.corners[2]] - a;
  Eigen::Matrix3d system;
  system << ab, ac, -along;
  const Eigen::Vector3d solution = system.partialPivLu().solve(eye - a);
  const bool inside = solution[0] >= 0 && solution[1] >= 0 && solution[0] + solution[1] <= 1 && solution[2] > 0;
  return inside ? solution[2] : std::numeric_limits<double>::infinity();
}

TEST(Frame, labelsAgreeWithACastByHand) {
  int wrong = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sim::CameraFixture fixture;
    fixture.addBoard("wall", 5, 0, 0, 5, 5);
    sim::Random random(seed, {});
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d axis(random.gaussian(), random.gaussian(), random.gaussian());
      sim::MeshBuilder box("box_" + std::to_string(i),
                           sim::Track({Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, 3), axis.normalized())),
                                       {random.uniform(1.5, 4), random.uniform(-1, 1), random.uniform(-1, 1)}}));
      box.addBoxOfPlanes("", sim::SurfaceKind::object, {}, {-0.2, -0.3, -0.1}, {0.2, 0.3, 0.1});
      fixture.world.bodies.push_back(box.build());
    }
    const sim::Scenes scenes(fixture.world);
    const Pinhole camera = Pinhole::centred(80, 60, 60);
    const Frame frame = sim::castFrame(scenes, scenes.at(0), camera, kLookingAlongX);
    const std::vector<std::uint16_t> labels = sim::labelsOf(frame);
    for (int row = 0; row < camera.height; ++row) {
      for (int column = 0; column < camera.width; ++column) {
        const Eigen::Vector3d along = kLookingAlongX.rotation * camera.through(column, row);
        double nearest = std::numeric_limits<double>::infinity();
        int label = 0, first = 1;
        for (const sim::Body& body : fixture.world.bodies) {
          for (const sim::Triangle& triangle : body.triangles) {
            const double depth = meet(body, triangle, {0, 0, 0}, along);
            if (depth < nearest) nearest = depth, label = first + triangle.surface;
          }
          first += static_cast<int>(body.surfaces.size());
        }
        wrong += labels[row * camera.width + column] != label;
        ++all;
      }
    }
  }
  EXPECT_LE(wrong, 0.001 * all);
}

TEST(Frame, behindGlassIsSeenWithTheLightThatComesThrough) {
  sim::CameraFixture fixture;
  sim::Material glass;
  glass.transmission = 0.5f;
  fixture.addBoard("pane_1", 1, 0, 0, 0.4, 4, glass);
  fixture.addBoard("pane_2", 2, 0, 0, 4, 4, glass);
  fixture.addBoard("wall", 3, 0, 0, 9, 9);
  const sim::Scenes scenes(fixture.world);
  const Frame frame = sim::castFrame(scenes, scenes.at(0), Pinhole::centred(33, 3, 20), kLookingAlongX);
  EXPECT_EQ(frame.at(16, 1).surface, 0);  // labels are those of the pane
  EXPECT_EQ(frame.at(0, 1).surface, 1);
  ASSERT_EQ(frame.seen_through.size(), 99u);
  for (const auto& seen : frame.seen_through) {
    EXPECT_EQ(seen.hit.surface, 2);
    EXPECT_NEAR(seen.hit.depth, 3, 1e-12);
    const int beside = std::abs(seen.pixel % 33 - 16);
    EXPECT_FLOAT_EQ(seen.transmission, beside <= 4 ? 0.25f : 0.5f);  // the first pane ends 4 pixels aside
  }
}

// A board from y = -0.2 to 0.2 at 1 m, a wall at 2 m, a projector 7.5 cm to the right. The light that just passes the
// board's left edge meets the wall at 0.075 + 2 * (-0.2 - 0.075) = -0.475 m, seen at -0.2375 of the focal length; the
// edge itself is seen at -0.2. So 580 * 0.0375 = 21.75 pixels of wall left of the board are dark, and none on the
// right.
TEST(Frame, theProjectorsShadowLiesOnTheLeftAndIsAsWideAsTheDisparityJumps) {
  sim::CameraFixture fixture;
  fixture.addBoard("board", 1, 0, 0, 0.4, 4);
  fixture.addBoard("wall", 2, 0, 0, 9, 9);
  const sim::Scenes scenes(fixture.world);
  const Pinhole camera = Pinhole::centred(640, 5, 580);
  const Frame frame = sim::castFrame(scenes, scenes.at(0), camera, kLookingAlongX);
  const std::vector<char> shadow = sim::findShadow(frame, scenes.at(0), {0.075, 0, 0});
  const double board_begins = camera.cx - 0.2 * camera.fx;
  int dark = 0;
  for (int column = 0; column < camera.width; ++column) {
    if (!shadow[2 * camera.width + column]) continue;
    ++dark;
    EXPECT_LT(column, board_begins);
    EXPECT_GT(column, board_begins - 21.75 - 1);
  }
  EXPECT_NEAR(dark, 21.75, 1);
}

}  // namespace
}  // namespace frame_test
