#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/live/LiveOptions.h>
#include <omnimapper/live/SensorDriver.h>

#include <memory>

namespace omnimapper::plugins::make_driver_test {
namespace {

std::unique_ptr<live::SensorDriver> made(const std::string& driver, const std::string& keys = "") {
  const auto config =
      base::Config::fromText("[live]\nsensors = one\n[one]\ndriver = " + driver + "\n" + keys, "robot.ini");
  return live::makeDriver(live::readSensors(config.section("live").read<live::LiveOptions>(), config).at(0));
}

TEST(MakeDriver, DriversOfMrptAndOfTheProjectAreMadeAlike) {
  EXPECT_EQ(made("CHokuyoURG", "sensorLabel = LASER\nCOM_port_LIN = /dev/ttyACM0\n")->label(), "LASER");
  EXPECT_TRUE(made("COdometryLines")->waitsForOthers());
}

TEST(MakeDriver, AnOptionalDriverIsMadeOrTheErrorSaysWhatToInstall) {
  const auto drivers = base::namesOfFeatures(base::Registered::driver);
  EXPECT_FALSE(drivers.empty());
  for (const auto& driver : drivers) {
    try {
      EXPECT_NE(made(driver)->label(), "") << driver;
      EXPECT_EQ(base::whyUnavailable(driver), "");
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unknown_plugin);
      EXPECT_NE(std::string(error.what()).find("it belongs to the feature"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("(Debian: lib"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace omnimapper::plugins::make_driver_test
