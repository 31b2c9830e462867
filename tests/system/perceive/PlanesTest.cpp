// Planes and laser lines that ini/perceive.ini finds in a log, which MRPT's own tools can read.
#include <mrpt/img/CImage.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/source/RawlogWriter.h>

#include <sstream>

#include "PerceiveRuns.h"

namespace {

using namespace perceived;
using omnimapper::obs::CObservationLaserLines;
using omnimapper::obs::CObservationPlanes;

class Planes : public PerceivedHome {};

std::string bytesOf(const mrpt::obs::CObservation& observation) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << observation;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

/// Number of planes of a log that are the floor: level and within 3 cm of the height of the base's origin.
std::size_t countFloors(const Observations& all) {
  std::size_t floors = 0;
  for (const auto& planes : ofClass<CObservationPlanes>(all)) {
    const auto base_from_sensor = omnimapper::geometry::fromMrpt(planes->sensorPose);
    for (const auto& plane : planes->planes) {
      const auto in_base = base_from_sensor * plane.plane_in_sensor;
      floors += in_base.normal.z() > 0.999 && std::abs(in_base.distance) < 0.03;
    }
  }
  return floors;
}

TEST_F(Planes, OfASimulatedHomeIncludeItsFloor) {
  const auto all = readLog(derived_);
  const auto planes = ofClass<CObservationPlanes>(all);
  EXPECT_EQ(planes.size(), 16U);
  EXPECT_EQ(ofClass<CObservationLaserLines>(all).size(), 301U);
  EXPECT_EQ(planes.front()->sensorLabel, "kinect.planes");
  EXPECT_EQ(planes.front()->source_label, "kinect");
  EXPECT_GE(countFloors(all), 12U) << "the camera looks down by 10 degrees";
}

TEST_F(Planes, AreTheSameBytesOnAnyNumberOfThreadsAndBesideTheRawLog) {
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, scratch_ / "again.rawlog", {"--threads", "3"})));
  EXPECT_TRUE(readFile(scratch_ / "again.rawlog") == readFile(derived_));
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, scratch_ / "both.rawlog", {"--with-raw"})));
  const auto alone = ofClass<CObservationPlanes>(readLog(derived_)),
             beside = ofClass<CObservationPlanes>(readLog(scratch_ / "both.rawlog"));
  ASSERT_EQ(alone.size(), beside.size());
  for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_TRUE(bytesOf(*alone[i]) == bytesOf(*beside[i])) << i;
}

TEST_F(Planes, MapAlikeFromTheRawLogAndFromWhatWasDerived) {
  const Texts more{"-i", omnimapper::testing::sourceFile("ini/perceive.ini"), "--set",
                   "perception.extractors=laser_points, planes, edges, cloud_planes, laser_lines"};
  ASSERT_TRUE(endedWith(ExitCode::ok, map({kHome}, scratch_ / "raw", more)));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({kHome, derived_}, scratch_ / "merged", more)));
  for (const char* file : {"trajectory.tum", "graph.g2o", "grid.png"}) {
    EXPECT_TRUE(readFile(scratch_ / "merged" + "/" + file) == readFile(scratch_ / "raw" + "/" + file)) << file;
  }
}

TEST_F(Planes, ScansWithoutCalibrationEndNoMapAndAreReported) {
  const std::string bad = scratch_ / "bad.rawlog";
  omnimapper::source::writeRawlog(bad, [&](omnimapper::source::RawlogWriter& rawlog) {
    for (const auto& observation : readLog(kHome)) {
      if (auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation))
        scan->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
      rawlog.add(*observation);
    }
  });
  const Texts more{"-i", omnimapper::testing::sourceFile("ini/perceive.ini"), "--set",
                   "perception.extractors=laser_points, planes"};
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, map({bad}, scratch_ / "bad", more),
                        {"an extractor could not process", "'kinect' at 17000000", "calibrate"}));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({kHome}, scratch_ / "good", more)));
  EXPECT_TRUE(readFile(scratch_ / "bad/trajectory.tum") == readFile(scratch_ / "good/trajectory.tum"));
  EXPECT_TRUE(fs::exists(scratch_ / "bad/map.omnimap"));
}

TEST_F(Planes, AreCountedAndThePluginsListed) {
  const auto ended = perceive(kHome, derived_, {"-v"});
  EXPECT_TRUE(endedWith(ExitCode::ok, ended));
  std::size_t planes = 0;
  for (const auto& one : ofClass<CObservationPlanes>(readLog(derived_))) planes += one->planes.size();
  for (const auto& words : {"kinect.planes: " + std::to_string(planes) + " planes in 16 observations",
                            std::string(" lines in 301 obs"), std::string("CObservation3DRangeScan")})
    EXPECT_NE(ended.out.find(words), std::string::npos) << words << "\n" << ended.out;
  const std::string program = omnimapper::testing::ownProgram("omnimapper-perceive");
  EXPECT_NE(runProgram({program, "--list-plugins"}).out.find("PlaneExtractor"), std::string::npos);
  EXPECT_NE(runProgram({program, "--print-ini", "PlaneExtractor"}).out.find("scale_sigma"), std::string::npos);
  EXPECT_TRUE(endedWith(ExitCode::command_line, runProgram({program}), {"-i", "-r", "-o"}));
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, perceive(kHome, scratch_ / "none/x.rawlog"), {"none/x.rawlog"}));
  EXPECT_TRUE(endedWith(ExitCode::unwritable_output, perceive(kHome, derived_, {"--pictures", derived_ + "/below"}),
                        {"permissions"}));
  EXPECT_TRUE(endedWith(ExitCode::wrong_type, perceive(kHome, derived_, {"--set", "planes.min_pixels=many"}),
                        {"--set planes.min_pixels: [planes]"}));
}

TEST_F(Planes, NoLevelSurfaceForObjectsIsReported) {
  const std::string ini = omnimapper::testing::sourceFile("ini/objects.ini"), objects = scratch_ / "objects.rawlog";
  const std::string program = omnimapper::testing::ownProgram("omnimapper-perceive");
  const auto good = runProgram({program, "-i", ini, "-r", kHome, "-o", objects});
  EXPECT_TRUE(endedWith(ExitCode::ok, good));
  EXPECT_EQ(good.err.find("level"), std::string::npos) << good.err;
  // The INI says that the camera looks down by 45 degrees, so no surface is level.
  EXPECT_TRUE(endedWith(
      ExitCode::ok,
      runProgram({program, "-i", ini, "-r", kHome, "-o", objects, "--set", "mapper.sensors=camera", "--set",
                  "camera.label=kinect", "--set", "camera.pose_pitch_deg=45", "--set", "objects.max_tilt_deg=5"}),
      {"[objects]", "level surface", "max_tilt_deg"}));
}

TEST_F(Planes, AreDescribedAndExportedByRawlogEdit) {
  if (!isInstalled("rawlog-edit")) GTEST_SKIP() << "rawlog-edit (Debian package mrpt-apps) is not installed";
  // Runs in the folder of the log, because --export-txt of 2.5.8 loses the slash between folder and file.
  const auto edit = [&](const std::string& operation) {
    return runProgram(
        {"sh", "-c",
         "cd '" + scratch_.path() + "' && rawlog-edit -p '" OMNIMAPPER_OBS_LIBRARY "' -i home.rawlog " + operation});
  };
  const auto described = edit("--describe");
  ASSERT_EQ(described.code, 0) << toString(described);
  for (const char* word :
       {"CObservationPlanes", "kinect.planes", "outline of", "CObservationLaserLines", "laser.lines"})
    EXPECT_NE(described.out.find(word), std::string::npos) << word;
  const auto exported = edit("--export-txt");
  ASSERT_EQ(exported.code, 0) << toString(exported);
  const std::string text = readFile(scratch_ / "home_kinect.planes.txt");
  std::istringstream lines(text);
  std::string header, row;
  ASSERT_TRUE(std::getline(lines, header) && std::getline(lines, row));
  EXPECT_NE(header.find("planes { nx ny nz distance_m"), std::string::npos) << header;
  std::istringstream numbers(row);
  double stamp = 0, count = 0, nx = 0, ny = 0, nz = 0;
  numbers >> stamp >> count >> nx >> ny >> nz;
  EXPECT_EQ(stamp, 1700000000);
  EXPECT_EQ(count, static_cast<double>(ofClass<CObservationPlanes>(readLog(derived_)).front()->planes.size()));
  EXPECT_NEAR(nx * nx + ny * ny + nz * nz, 1, 1e-9);
}

TEST_F(Planes, AreShownInPictures) {
  const std::string folder = scratch_ / "pictures";
  const auto ended = perceive(kHome, derived_, {"--pictures", folder, "--picture-every", "8"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("40 pictures in "), std::string::npos) << ended.out;
  const auto files = filesIn(folder);
  EXPECT_EQ(files.size(), 40U);
  ASSERT_EQ(files.count("kinect_1700000000.000000.png"), 1U);
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile(folder + "/kinect_1700000000.000000.png"));
  EXPECT_EQ(picture.getWidth(), 640U);
  EXPECT_TRUE(endedWith(ExitCode::command_line, perceive(kHome, derived_, {"--picture-every", "0"})));
}

// The tests above are its simulated twins.
TEST(PlanesRecording, OfFreiburg1Rpy) {
  const auto folder = omnimapper::testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  const omnimapper::testing::ScratchFolder scratch;
  importFirst(*folder, 20, "freiburg1", scratch);
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(scratch / "raw.rawlog", scratch / "derived.rawlog")));
  const auto planes = ofClass<CObservationPlanes>(readLog(scratch / "derived.rawlog"));
  ASSERT_GE(planes.size(), 15U);
  for (const auto& frame : planes) {
    ASSERT_FALSE(frame->planes.empty());
    EXPECT_GT(frame->planes[0].inliers, 20000U) << "the largest of a desk, a floor and a wall";
    EXPECT_TRUE(frame->planes[0].colour);
  }
}

TEST_F(Planes, NeitherTheLogThatIsReadNorAGoodOldOutputIsLost) {
  const std::string log = scratch_ / "copy.rawlog", output = scratch_ / "derived.rawlog";
  fs::copy_file(kHome, log);
  const std::string content = readFile(log);
  EXPECT_TRUE(endedWith(ExitCode::command_line, perceive(log, log), {"copy.rawlog", "another name"}));
  EXPECT_EQ(readFile(log), content);

  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(log, output)));
  const std::string good = readFile(output);
  writeFile(log, content.substr(0, 20000));  // before the first depth image ends
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, perceive(log, output, {"--set", "perception.extractors=planes"}),
                        {"copy.rawlog", "nothing was written"}));
  EXPECT_EQ(readFile(output), good);
}

}  // namespace
