#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/perception/ObjectExtractor.h>

#include "../camera/RangeScans.h"
#include "TableScene.h"

namespace omnimapper::perception::object_extractor_test {
namespace {

using rooms::TableScene;

/// Scan from a height of 1.4 m of a table with a block of 10 x 15 x 20 cm on it, with a red and green picture.
mrpt::obs::CObservation3DRangeScan tableScan() {
  TableScene table;
  table.addBlock({1, 0, 0.8}, {0.1, 0.15, 0.2});
  const auto view = rooms::render(table.scene);
  auto scan = camera::scans::rangeScan(
      [&](int x, int y) { return double{view.depth[static_cast<std::size_t>(640 * y + x)]}; }, 640, 480);
  camera::scans::addColours(scan, 640, 480);
  scan.cameraParams.setIntrinsicParamsFromValues(525, 525, 319.5, 239.5);
  scan.cameraParamsIntensity = scan.cameraParams;
  scan.sensorPose = mrpt::poses::CPose3D(0, 0, 1.4, 0, 35 * M_PI / 180, 0);
  return scan;
}

ObjectExtractor::Found extract(const mrpt::obs::CObservation3DRangeScan& scan) {
  return ObjectExtractor(ObjectExtractor::Options()).extract(scan);
}

std::string bytesOf(const mrpt::obs::CObservation& observation) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << observation;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

TEST(ObjectExtractor, ABlockOnATableIsWhereItStands) {
  const auto scan = tableScan();
  const auto [planes, objects, has_surface] = extract(scan);
  EXPECT_TRUE(has_surface);
  EXPECT_EQ(objects->sensorLabel, "kinect.objects");
  EXPECT_EQ(objects->source_label, "kinect");
  EXPECT_EQ(objects->timestamp, scan.timestamp);
  EXPECT_EQ(objects->sensorPose, scan.sensorPose);
  ASSERT_EQ(objects->objects.size(), 1U);
  const auto& block = objects->objects[0];
  const auto base_from_box = geometry::fromMrpt(scan.sensorPose) * block.sensor_from_box;
  EXPECT_LT((base_from_box.translation - Eigen::Vector3d(1, 0, 0.8)).norm(), 0.02);
  EXPECT_LT((base_from_box.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 0.01);
  EXPECT_NEAR(block.box_size.x(), 0.15, 0.01);
  EXPECT_NEAR(block.box_size.y(), 0.1, 0.01);
  ASSERT_TRUE(block.supporting_plane && *block.supporting_plane < planes->planes.size());
  const auto table = geometry::fromMrpt(scan.sensorPose) * planes->planes[*block.supporting_plane].plane_in_sensor;
  EXPECT_NEAR(table.distance, -0.7, 1e-3);
}

TEST(ObjectExtractor, KeepsPointsWithColours) {
  const auto scan = tableScan();
  ObjectExtractor::Options options;
  options.points.max_points = 200;
  const auto found = ObjectExtractor(options).extract(scan);
  const auto& block = found.objects->objects.at(0);
  EXPECT_GT(block.points.size(), 100U);
  EXPECT_LE(block.points.size(), 200U);
  ASSERT_EQ(block.colours.size(), block.points.size());
  for (std::size_t i = 0; i < block.points.size(); ++i) {
    const bool is_left = block.points[i].y() > 0;
    EXPECT_EQ(block.colours[i], (is_left ? obs::Rgb{200, 10, 20} : obs::Rgb{30, 220, 40})) << block.points[i].y();
    const Eigen::Vector3d in_base =
        geometry::fromMrpt(scan.sensorPose) * Eigen::Vector3d(block.points[i].cast<double>());
    EXPECT_GT(in_base.z(), 0.7);
    EXPECT_LT(in_base.z(), 0.905);
  }
  ASSERT_TRUE(block.colour);
  EXPECT_NEAR(block.colour->red, 115, 15) << "as much of it is red as is green";
}

TEST(ObjectExtractor, ItsPlanesAreThoseOfThePlaneExtractor) {
  const auto scan = tableScan();
  EXPECT_TRUE(bytesOf(*extract(scan).planes) == bytesOf(*PlaneExtractor({}, {}).extract(scan)));
}

TEST(ObjectExtractor, RepetitionChangesNoBitAndNothingIsNothing) {
  const auto scan = tableScan();
  EXPECT_TRUE(bytesOf(*extract(scan).objects) == bytesOf(*extract(scan).objects));
  const auto nothing = extract(mrpt::obs::CObservation3DRangeScan());
  EXPECT_TRUE(nothing.planes->planes.empty() && nothing.objects->objects.empty());
}

}  // namespace
}  // namespace omnimapper::perception::object_extractor_test
