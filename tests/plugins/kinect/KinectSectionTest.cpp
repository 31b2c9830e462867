#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/SensorDriver.h>

namespace omnimapper::plugins::kinect_section_test {
namespace {

std::string labelOf(const std::string& keys) {
  const auto config =
      base::Config::fromText("[live]\nsensors = kinect\n[kinect]\ndriver = KinectSensor\n" + keys, "robot.ini");
  const auto sensors = live::readSensors(config.section("live").read<live::LiveOptions>(), config);
  return live::makeDriver(sensors.at(0))->label();
}

TEST(KinectSection, isReadWhereTheSensorIsMade) {
  EXPECT_EQ(labelOf(""), "KINECT");
  EXPECT_EQ(labelOf("sensorLabel = head\nmax_range_m = 5\n"), "head");
}

TEST(KinectSection, aWrongKeyIsRefusedWhereTheSensorIsMade) {
  try {
    labelOf("max_range_m = 20\n");
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::out_of_range);
    EXPECT_NE(std::string(error.what()).find("[kinect]: max_range_m = 20"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::plugins::kinect_section_test
