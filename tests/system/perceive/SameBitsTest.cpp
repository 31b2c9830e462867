// The kernels for AVX2 and those for any x86-64 give the same bytes for one log.
#include <omnimapper/obs/CObservationPlanes.h>

#include "PerceiveRuns.h"

namespace {

using namespace perceived;

class SameBits : public ::testing::Test {
 protected:
  // Runs the extractors on a log without AVX2.
  Ended perceiveWithout(const std::string& log, const std::string& output, const Texts& more) {
    Texts words{"env", "OMNIMAPPER_AVX2=0"};
    const Texts command = perceiving(log, output, more);
    words.insert(words.end(), command.begin(), command.end());
    return runProgram(words);
  }
  // Runs the extractors with and without AVX2, expects the same bytes, and returns the observations.
  Observations madeAlike(const std::string& log, const Texts& more) {
    const std::string with = scratch_ / "with.rawlog", without = scratch_ / "without.rawlog";
    EXPECT_TRUE(endedWith(ExitCode::ok, perceive(log, with, more)));
    EXPECT_TRUE(endedWith(ExitCode::ok, perceiveWithout(log, without, more)));
    EXPECT_TRUE(readFile(with) == readFile(without)) << ::testing::PrintToString(more);
    return readLog(with);
  }

  const std::string kHome = omnimapper::testing::sourceFile("rawlogs/home_30s/home_30s.rawlog");
  omnimapper::testing::ScratchFolder scratch_;
};

TEST_F(SameBits, OfPlanesEdgesAndLines) {
  EXPECT_GT(madeAlike(kHome, {}).size(), 300U);
}

TEST_F(SameBits, OfPlanesByNormals) {
  EXPECT_EQ(madeAlike(kHome, {"--set", "perception.extractors=planes", "--set", "planes.comparator=normals"}).size(),
            16U);
}

TEST_F(SameBits, OfObjectsAndRoads) {
  EXPECT_EQ(madeAlike(kHome, {"--set", "perception.extractors=planes, road", "--set", "planes.class=ObjectExtractor",
                              "--set", "road.class=RoadExtractor"})
                .size(),
            3 * 16U);
}

TEST_F(SameBits, OfPlanesOfClouds) {
  const std::string edges = scratch_ / "edges.rawlog";
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, edges, {"--set", "perception.extractors=edges"})));
  const auto found = madeAlike(
      edges, {"--set", "perception.extractors=cloud_planes", "--set",
              "cloud_planes.sensor_labels=kinect.edges.boundary, kinect.edges.occluded, kinect.edges.high_curvature",
              "--set", "cloud_planes.min_points=20", "--set", "cloud_planes.voxel_m=0"});
  std::size_t planes = 0;
  for (const auto& one : ofClass<omnimapper::obs::CObservationPlanes>(found)) planes += one->planes.size();
  EXPECT_GT(planes, 0U);
}

}  // namespace
