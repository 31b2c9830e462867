#include <gtest/gtest.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/SensorDriver.h>

namespace omnimapper::plugins::xtion_section_test {
namespace {

TEST(XtionSection, isReadWhereTheSensorIsMade) {
  const std::string ini = "[live]\nsensors = xtion\n[xtion]\ndriver = COpenNI2Sensor\n";
  for (const auto& [keys, label] : {std::pair("", "OPENNI2"), std::pair("sensorLabel = XTION\n", "XTION")}) {
    const auto config = base::Config::fromText(ini + keys, "robot.ini");
    const auto sensors = live::readSensors(config.section("live").read<live::LiveOptions>(), config);
    EXPECT_EQ(live::makeDriver(sensors.at(0))->label(), label);
  }
}

}  // namespace
}  // namespace omnimapper::plugins::xtion_section_test
