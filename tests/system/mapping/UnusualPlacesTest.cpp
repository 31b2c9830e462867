// ini/home_planes.ini in places that are no homes: a room without doors, a camera that hangs upside down, a sloped
// road, and a map without surfaces. omnimapper-eval map compares their surfaces with the truth.
#include "../MapFolder.h"

namespace {

using namespace runs;
using nlohmann::json;
using omnimapper::testing::ownProgram;
using omnimapper::testing::sourceFile;

class UnusualPlaces : public ::testing::Test {
 protected:
  // Simulates, maps and compares, and returns the numbers of omnimapper-eval map.
  json judged(const std::string& rawlog_ini, const Texts& world, const Texts& mapping = {},
              const std::string& align = "se3") {
    Texts simulate{
        ownProgram("omnimapper-simulate"), "-i", sourceFile(rawlog_ini), "-o", scratch_ / "log", "--name", "log"};
    for (const auto& setting : world) simulate.insert(simulate.end(), {"--set", setting});
    EXPECT_TRUE(endedWith(ExitCode::ok, runProgram(simulate)));
    Texts map{"-i", sourceFile("ini/home_planes.ini"), "-r", scratch_ / "log/log.rawlog", "-o", scratch_ / "map"};
    for (const auto& setting : mapping) map.insert(map.end(), {"--set", setting});
    EXPECT_TRUE(endedWith(ExitCode::ok, graphslam(map)));
    EXPECT_TRUE(endedWith(ExitCode::ok, runProgram({ownProgram("omnimapper-eval"), "map", scratch_ / "map",
                                                    scratch_ / "log", "-o", scratch_ / "quality", "--align", align})));
    return json::parse(readFile(scratch_ / "quality/numbers.json"));
  }
  // Settings that add a depth camera with three images a second.
  static Texts withCamera(const std::string& sensors) {
    return {"simulation.sensors=" + sensors, "simulation.duration_s=20", "kinect.class=RgbdCamera",
            "kinect.model=kinect",           "kinect.x_m=0.1",           "kinect.z_m=1.1",
            "kinect.pitch_deg=10",           "kinect.rate_hz=3",         "kinect.colour=false"};
  }

  omnimapper::testing::ScratchFolder scratch_;
};

TEST_F(UnusualPlaces, ARoomWithoutDoorsIsFourWallsAndAFloor) {
  const auto found = judged("rawlogs/box.ini", withCamera("laser,kinect,odometry"));
  EXPECT_EQ(found["drawn"], 5);
  EXPECT_EQ(found["found_once"], found["sought"]);
  EXPECT_EQ(found["labels"]["wall"], json({{"wall", 4}}));
  EXPECT_EQ(found["labels"]["floor"], json({{"floor", 1}}));
  EXPECT_EQ(found["spurious"], 0);
}

TEST_F(UnusualPlaces, ACameraThatHangsUpsideDownSeesTheSamePlace) {
  auto world = withCamera("laser,kinect,odometry");
  world.emplace_back("kinect.roll_deg=180");
  const auto found = judged("rawlogs/home.ini", world);
  EXPECT_EQ(found["labels"]["floor"], json({{"floor", 1}})) << "the surface below must be the floor";
  EXPECT_FALSE(found["labels"].contains("ceiling"));
  EXPECT_GE(found["found"].get<int>(), 8);
  EXPECT_LE(found["spurious"].get<int>(), 1);
  EXPECT_LE(found["doubled_pairs"].get<int>(), 1);
}

TEST_F(UnusualPlaces, ASlopedRoadOutdoorsIsGroundAndHasNoRooms) {
  auto world = withCamera("laser,kinect,odometry");
  world.insert(world.end(), {"laser.class=Laser2d", "laser.model=sick_lms291", "laser.z_m=0.35"});
  // The drive is straight, so that positions alone do not determine the turn about it.
  const auto found = judged("rawlogs/road.ini", world, {}, "yaw");
  const auto& labels = found["labels"];
  EXPECT_TRUE(labels.contains("floor") || labels.contains("ramp"));
  for (const char* none : {"ceiling", "door", "door frame", "counter", "window"}) EXPECT_FALSE(labels.contains(none));
  EXPECT_LE(found["drawn"].get<int>(), 10);
}

TEST_F(UnusualPlaces, AMapWithoutSurfacesHasNothingOfThePlaceAndIsNoError) {
  const auto found = judged("rawlogs/box.ini", withCamera("laser,kinect,odometry"),
                            {"plane_landmarks.min_area_m2=1000", "plane_landmarks.min_length_m=1000"});
  EXPECT_EQ(found["drawn"], 0);
  EXPECT_EQ(found["found"], 0);
  EXPECT_EQ(found["sought"], 4);
  EXPECT_EQ(found["labels"], json::object());
}

}  // namespace
