#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/ObjectFinder.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>

#include "TableScene.h"

namespace omnimapper::perception::object_finder_test {
namespace {

using Eigen::Vector3d;
using rooms::TableScene;

struct Found {
  PlaneSegmentation planes;
  std::vector<ObjectRegion> objects;
};

Found find(const TableScene& table, const std::vector<float>& depth, const ObjectOptions& options = {},
           const PlaneOptions& sensor = {}) {
  const camera::DepthImage image(depth.data(), 640, 480, table.scene.camera);
  Found found;
  found.planes = PlaneSegmenter(sensor).segment(image);
  found.objects = ObjectFinder(options, sensor).find(image, found.planes, table.up);
  return found;
}

Found find(const TableScene& table, const ObjectOptions& options = {}) {
  return find(table, rooms::render(table.scene).depth, options);
}

TableScene withThreeObjects() {
  TableScene table;
  table.addBlock({0.9, 0.35, 0.8}, {0.1, 0.15, 0.2});
  table.addBlock({1, 0, 0.76}, {0.08, 0.3, 0.12}, 0.5);
  table.addBlock({1.1, -0.35, 0.75}, {0.1, 0.1, 0.1}, -0.3);
  return table;
}

Vector3d inRoom(const TableScene& table, const Vector3d& in_camera) {
  return table.room_from_camera * in_camera;
}

TEST(ObjectFinder, ThreeBlocksOnATableWithTheirBoxes) {
  const TableScene table = withThreeObjects();
  const auto found = find(table);
  ASSERT_EQ(found.objects.size(), 3U);
  std::set<int> surfaces;
  for (const auto& object : found.objects) {
    ASSERT_TRUE(object.surface);
    surfaces.insert(*object.surface);
    const Vector3d axis = table.room_from_camera.linear() * (object.sensor_from_box.rotation * Vector3d::UnitZ());
    EXPECT_LT((axis - Vector3d::UnitZ()).norm(), 1e-3) << "upright";
    EXPECT_TRUE(std::is_sorted(object.pixels.begin(), object.pixels.end()));
  }
  ASSERT_EQ(surfaces.size(), 1U);
  const auto& top = found.planes.planes[static_cast<std::size_t>(*surfaces.begin())];
  EXPECT_NEAR(inRoom(table, top.centroid).z(), 0.7, 1e-3);
  // Of the long block the top and two sides are visible.
  const auto& block =
      *std::min_element(found.objects.begin(), found.objects.end(), [&](const ObjectRegion& a, const ObjectRegion& b) {
        return std::abs(inRoom(table, a.centroid).y()) < std::abs(inRoom(table, b.centroid).y());
      });
  EXPECT_NEAR(block.box_size.x(), 0.3, 0.01);
  EXPECT_NEAR(block.box_size.y(), 0.08, 0.01);
  EXPECT_NEAR(block.box_size.z(), 0.12, 0.005);
  EXPECT_LT((inRoom(table, block.sensor_from_box.translation) - Vector3d(1, 0, 0.76)).norm(), 0.01);
}

TEST(ObjectFinder, NoiseOfAKinectChangesLittle) {
  const TableScene table = withThreeObjects();
  testing::Dice dice(7);
  const auto depth = rooms::withNoise(rooms::render(table.scene), 640, 480, camera::DepthNoise(), dice);
  const auto found = find(table, depth);
  ASSERT_EQ(found.objects.size(), 3U);
  const auto exact = find(table);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((found.objects[i].box_size - exact.objects[i].box_size).norm(), 0.03) << i;
    EXPECT_LT((found.objects[i].centroid - exact.objects[i].centroid).norm(), 0.01) << i;
  }
}

TEST(ObjectFinder, ABlockOnTheFloorStandsOnTheFloor) {
  TableScene table;
  table.scene.faces.erase(table.scene.faces.begin() + 6, table.scene.faces.begin() + 12);  // the table
  table.addBlock({1.6, 0, 0.2}, {0.3, 0.2, 0.4});
  const auto found = find(table);
  ASSERT_EQ(found.objects.size(), 1U);
  const auto& floor = found.planes.planes[static_cast<std::size_t>(*found.objects[0].surface)];
  EXPECT_NEAR(inRoom(table, floor.centroid).z(), 0, 1e-3);
  EXPECT_NEAR(found.objects[0].box_size.z(), 0.4, 0.005);
}

TEST(ObjectFinder, ComparatorsDifferAtConcaveBoundaries) {
  TableScene table;
  table.addBlock({1, 0, 0.75}, {0.2, 0.2, 0.1});
  table.addBlock({1, 0, 0.85}, {0.1, 0.1, 0.1});  // on it
  ObjectOptions options;
  options.comparator = ObjectOptions::Comparator::euclidean;
  const auto together = find(table, options).objects;
  ASSERT_EQ(together.size(), 1U);
  EXPECT_NEAR(together[0].box_size.z(), 0.2, 0.005);
  options.comparator = ObjectOptions::Comparator::locally_convex;
  const auto apart = find(table, options).objects;
  ASSERT_EQ(apart.size(), 2U);
  EXPECT_EQ(apart[0].pixels.size() + apart[1].pixels.size(), together[0].pixels.size())
      << "no pixel is lost at the concave boundary";
  for (const auto& object : apart) EXPECT_NEAR(object.box_size.z(), 0.1, 0.02);
}

TEST(ObjectFinder, ATableInPiecesIsOneSurface) {
  TableScene table;
  table.addBlock({1, 0.3, 0.705}, {0.8, 0.6, 0.012});  // half of it is a centimetre higher
  table.addBlock({1, 0, 0.8}, {0.1, 0.2, 0.2});
  const auto found = find(table);
  ASSERT_EQ(found.objects.size(), 1U);
  EXPECT_NEAR(found.objects[0].box_size.x(), 0.2, 0.02);
}

TEST(ObjectFinder, ATableIsCoplanarWithItselfWhateverTheOptions) {
  ObjectOptions options;
  options.coplanar_distance = 0;
  PlaneOptions sensor;
  sensor.distortion_at_1m = 0;
  const TableScene table = withThreeObjects();
  EXPECT_EQ(find(table, rooms::render(table.scene).depth, options, sensor).objects.size(), 3U);
}

TEST(ObjectFinder, FiltersLeaveOutWhatIsTooSmallTooLargeOrHangs) {
  TableScene table = withThreeObjects();
  ObjectOptions options;
  options.min_points = 100000;
  EXPECT_TRUE(find(table, options).objects.empty());
  options = {};
  options.min_size = 0.25;
  EXPECT_EQ(find(table, options).objects.size(), 1U);
  options = {};
  options.max_volume = 0.0015;
  EXPECT_EQ(find(table, options).objects.size(), 1U) << "the smallest is 0.001 m^3";
  table.addBlock({1, 0, 1.15}, {0.1, 0.1, 0.1});  // in the air
  EXPECT_EQ(find(table).objects.size(), 3U);
  options = {};
  options.on_surfaces_only = false;
  std::size_t hanging = 0;
  for (const auto& object : find(table, options).objects) hanging += !object.surface;
  EXPECT_GE(hanging, 1U);
}

TEST(ObjectFinder, LegsAndRestsOfWallsAreNoObjects) {
  TableScene table;
  table.addBlock({1, -0.3, 0.9}, {0.04, 0.04, 0.4});
  EXPECT_TRUE(find(table).objects.empty());
  ObjectOptions options;
  options.max_aspect_ratio = 20;
  EXPECT_EQ(find(table, options).objects.size(), 1U);
  TableScene behind;
  behind.addBlock({1.3, 0.35, 0.95}, {0.02, 0.5, 0.5});  // a large board upright on the table
  behind.addBlock({1.3, -0.2, 0.85}, {0.02, 0.2, 0.3});  // a small one in the same plane, as the rest of a wall
  EXPECT_TRUE(find(behind).objects.empty());
  behind.addBlock({1.1, -0.2, 0.75}, {0.1, 0.1, 0.1});
  EXPECT_EQ(find(behind).objects.size(), 1U);
}

TEST(ObjectFinder, WallsAreNoTables) {
  TableScene table = withThreeObjects();
  table.up = -table.up;
  EXPECT_TRUE(find(table).objects.empty());
}

TEST(ObjectFinder, NothingMeasuredIsNoObject) {
  const TableScene table;
  EXPECT_TRUE(find(table, std::vector<float>(640 * 480, std::nanf(""))).objects.empty());
  EXPECT_TRUE(find(table, std::vector<float>(640 * 480, 1)).objects.empty()) << "constant depth";
  const camera::DepthImage nothing(static_cast<const float*>(nullptr), 0, 0, table.scene.camera);
  EXPECT_TRUE(ObjectFinder({}, {}).find(nothing, {}, table.up).empty());
  const float one = 1;
  const camera::DepthImage pixel(&one, 1, 1, table.scene.camera);
  EXPECT_TRUE(ObjectFinder({}, {}).find(pixel, PlaneSegmenter({}).segment(pixel), table.up).empty());
}

TEST(ObjectFinder, DepthsInAWrongUnitAreNoObjects) {
  const TableScene table = withThreeObjects();
  for (const float factor : {1000.F, 0.001F}) {  // millimetres as metres, metres as millimetres
    auto depth = rooms::render(table.scene).depth;
    for (float& each : depth) each *= factor;
    EXPECT_TRUE(find(table, depth).objects.empty()) << factor;
  }
}

TEST(ObjectFinder, WhatFillsTheViewStandsOnNothing) {
  std::vector<float> depth(640 * 480);  // a ball that is too near for its border to be in the image
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const auto squared = static_cast<float>((x - 320) * (x - 320) + (y - 240) * (y - 240));
      depth[static_cast<std::size_t>(640 * y + x)] = 0.5F + 2e-6F * squared;
    }
  }
  EXPECT_TRUE(find(TableScene(), depth).objects.empty());
}

TEST(ObjectFinder, RandomBytesGiveASoundResult) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    testing::Dice dice(seed);
    const int width = static_cast<int>(dice.uniform(1, 130)), height = static_cast<int>(dice.uniform(1, 90));
    std::vector<std::uint16_t> units(static_cast<std::size_t>(width * height));
    const double spread = dice.uniform(0, 1) < 0.3 ? 65535 : 60;
    for (auto& u : units) u = static_cast<std::uint16_t>(dice.uniform(0, spread) + (spread < 1000 ? 1000 : 0));
    // A nearer block, which in some images reaches over the border.
    for (int y = height / 3; y < height / 2; ++y) {
      for (int x = width / 2; x < width; ++x) units[static_cast<std::size_t>(y * width + x)] /= 2;
    }
    PlaneOptions sensor;
    sensor.min_pixels = 16;
    ObjectOptions options;
    options.on_surfaces_only = seed % 2 == 0;
    options.comparator =
        seed % 4 < 2 ? ObjectOptions::Comparator::euclidean : ObjectOptions::Comparator::locally_convex;
    options.min_points = 3;
    options.max_tilt = M_PI;
    const camera::DepthImage image(units.data(), 1e-3, width, height, {100, 100, 0.5 * width, 0.5 * height});
    const auto planes = PlaneSegmenter(sensor).segment(image);
    std::vector<bool> taken(units.size(), false);
    for (const auto& object : ObjectFinder(options, sensor).find(image, planes, Vector3d::UnitZ())) {
      EXPECT_GE(object.pixels.size(), 3U);
      EXPECT_TRUE(object.centroid.allFinite() && object.covariance.allFinite() && object.box_size.allFinite());
      EXPECT_TRUE(!object.surface || static_cast<std::size_t>(*object.surface) < planes.planes.size());
      for (const int pixel : object.pixels) {
        EXPECT_FALSE(taken[static_cast<std::size_t>(pixel)]);
        taken[static_cast<std::size_t>(pixel)] = true;
      }
    }
  }
}

TEST(ObjectFinder, CentroidsVaryAsTheirCovarianceSays) {
  TableScene table;
  table.addBlock({1, 0, 0.8}, {0.15, 0.3, 0.2}, 0.3);
  const auto view = rooms::render(table.scene);
  const auto exact = find(table, view.depth).objects.at(0);
  PlaneOptions sensor;
  sensor.distortion_at_1m = 0.004;
  testing::Dice dice(11);
  double chi_square = 0;
  constexpr int kTimes = 30;
  for (int i = 0; i < kTimes; ++i) {
    const auto depth = rooms::withNoise(view, 640, 480, camera::DepthNoise(), dice);
    const auto found = find(table, depth, {}, sensor);
    ASSERT_EQ(found.objects.size(), 1U);
    // The sensor's error is along the ray; across it the border of the cluster moves the centroid.
    const Vector3d ray = exact.centroid.normalized();
    const double error = ray.dot(found.objects[0].centroid - exact.centroid);
    chi_square += error * error / ray.dot(found.objects[0].covariance * ray);
  }
  EXPECT_LT(chi_square / kTimes, 1.5)
      << "no smaller than the error; larger, since this sensor has no systematic distortion";
  EXPECT_GT(exact.covariance.eigenvalues().real().minCoeff(), 0);
}

TEST(ObjectFinder, OptionsThatMakeNoSenseAreRefused) {
  const auto refused = [](const ObjectOptions& options, const PlaneOptions& sensor, const std::string& word) {
    try {
      ObjectFinder(options, sensor);
      ADD_FAILURE() << word << " was taken";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  PlaneOptions sensor;
  sensor.min_depth = sensor.max_depth;
  refused({}, sensor, "min_depth_m");
  ObjectOptions options;
  options.min_points = 0;
  refused(options, {}, "min_points");
  options = {};
  options.max_gap = -0.1;
  refused(options, {}, "max_gap_m");
  options = {};
  options.max_volume = std::nan("");
  refused(options, {}, "max_volume_m3");
  options = {};
  options.max_aspect_ratio = 0.5;
  refused(options, {}, "max_aspect_ratio");
  options = {};
  options.concave_angle = 0;
  refused(options, {}, "concave_angle_deg");
}

}  // namespace
}  // namespace omnimapper::perception::object_finder_test
