#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <omnimapper/mapper/Features.h>
#include <omnimapper/mapper/PluginRegistry.h>
#include <omnimapper/obs/CObservationPlanes.h>

namespace omnimapper::plugins::cloud_plane_extractor_test {
namespace {

mapper::PluginSet made(const std::string& options) {
  mapper::loadFeatures();
  const auto config = base::Config::fromText("[clouds]\nclass = CloudPlaneExtractor\n" + options, "test.ini");
  return mapper::makePlugins({{}, {"clouds"}, {}, {}}, config, {});
}

std::shared_ptr<obs::CObservationPlanes> planesOf(const mrpt::obs::CObservation& raw, const std::string& options = "") {
  const auto set = made(options);
  const auto& extractor = *set.extractors.front().plugin;
  EXPECT_TRUE(extractor.wants(raw));
  const auto derived = extractor.extract(raw);
  EXPECT_EQ(derived.size(), 1U);
  return std::dynamic_pointer_cast<obs::CObservationPlanes>(derived.at(0));
}

/// A floor 1 m below, 2 x 2 m.
template <class Add>
void addFloor(const Add& add) {
  for (int i = 0; i < 80; ++i) {
    for (int k = 0; k < 80; ++k) add(0.5F + 0.025F * static_cast<float>(i), -1 + 0.025F * static_cast<float>(k), -1.F);
  }
}

template <class Observation>
Observation labelled() {
  Observation observation;
  observation.sensorLabel = "velodyne";
  observation.timestamp = base::stampFromUnix(10);
  observation.setSensorPose(mrpt::poses::CPose3D(0.1, 0, 1, 0, 0, 0));
  return observation;
}

mrpt::obs::CObservationPointCloud cloud() {
  auto observation = labelled<mrpt::obs::CObservationPointCloud>();
  observation.pointcloud = mrpt::maps::CSimplePointsMap::Create();
  addFloor([&](float x, float y, float z) { observation.pointcloud->insertPoint(x, y, z); });
  return observation;
}

void expectFloor(const mrpt::obs::CObservation& raw) {
  const auto found = planesOf(raw);
  EXPECT_EQ(found->sensorLabel, "velodyne.planes");
  EXPECT_EQ(found->source_label, "velodyne");
  EXPECT_EQ(found->timestamp, raw.timestamp);
  EXPECT_EQ(found->sensorPose, mrpt::poses::CPose3D(0.1, 0, 1, 0, 0, 0));
  ASSERT_EQ(found->planes.size(), 1U);
  EXPECT_LT((found->planes[0].plane_in_sensor.normal - Eigen::Vector3d(0, 0, 1)).norm(), 1e-4);
  EXPECT_NEAR(found->planes[0].plane_in_sensor.distance, 1, 1e-4);
  EXPECT_NEAR(area(found->planes[0].outline), 4, 0.3);
}

TEST(CloudPlaneExtractorOfAnIni, FindsTheFloorOfACloud) {
  expectFloor(cloud());
}

TEST(CloudPlaneExtractorOfAnIni, FindsTheFloorOfAVelodyneScan) {
  auto scan = labelled<mrpt::obs::CObservationVelodyneScan>();
  addFloor([&](float x, float y, float z) {
    scan.point_cloud.x.push_back(x);
    scan.point_cloud.y.push_back(y);
    scan.point_cloud.z.push_back(z);
  });
  expectFloor(scan);
}

TEST(CloudPlaneExtractorOfAnIni, ObservationsWithoutPointsHaveNoPlanes) {
  EXPECT_TRUE(planesOf(labelled<mrpt::obs::CObservationVelodyneScan>())->planes.empty());
  EXPECT_TRUE(planesOf(labelled<mrpt::obs::CObservationPointCloud>())->planes.empty());
}

TEST(CloudPlaneExtractorOfAnIni, ACloudThatWasNotLoadedIsAnErrorThatNamesItsFile) {
  auto outside = labelled<mrpt::obs::CObservationPointCloud>();
  outside.setAsExternalStorage("/nowhere/cloud.txt",
                               mrpt::obs::CObservationPointCloud::ExternalStorageFormat::PlainTextFile);
  try {
    planesOf(outside);
    FAIL() << "nothing was thrown";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::missing_images);
    EXPECT_NE(std::string(error.what()).find("velodyne"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("/nowhere/cloud.txt"), std::string::npos) << error.what();
  }
}

TEST(CloudPlaneExtractorOfAnIni, TakesTheSensorsThatCountAndNothingElse) {
  const auto all = made(""), some = made("sensor_labels = left, velodyne\n"), others = made("sensor_labels = left\n");
  EXPECT_FALSE(all.extractors.front().plugin->wants(mrpt::obs::CObservation2DRangeScan()));
  EXPECT_TRUE(some.extractors.front().plugin->wants(cloud()));
  EXPECT_FALSE(others.extractors.front().plugin->wants(cloud()));
  for (const char* derived : {"laser.points", "kinect.edges.rgb"}) {
    auto of_extractor = cloud();
    of_extractor.sensorLabel = derived;
    EXPECT_FALSE(all.extractors.front().plugin->wants(of_extractor));
    EXPECT_TRUE(made(std::string("sensor_labels = ") + derived + "\n").extractors.front().plugin->wants(of_extractor));
  }
}

TEST(CloudPlaneExtractorOfAnIni, ReadsItsOptionsFromTheIni) {
  EXPECT_TRUE(planesOf(cloud(), "min_points = 7000\n")->planes.empty());
  EXPECT_EQ(planesOf(cloud(), "outline = convex\n")->planes.at(0).outline.vertices.size(), 4U);
  EXPECT_THROW(made("min_range_m = 100\n"), base::Error);
  EXPECT_THROW(made("outline = round\n"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::cloud_plane_extractor_test
