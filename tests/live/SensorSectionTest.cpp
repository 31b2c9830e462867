#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/SensorDriver.h>
#include <omnimapper/live/SensorSection.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

namespace omnimapper::live::sensor_section_test {
namespace {

namespace fs = std::filesystem;

const std::string kLaser = "[front]\ndriver = CHokuyoURG\nsensorLabel = LASER\nCOM_port_LIN = /dev/ttyACM0\n";

std::vector<SensorSection> sensorsOf(const std::string& text) {
  const auto config = base::Config::fromText(text, "robot.ini");
  return readSensors(config.section("live").read<LiveOptions>(), config);
}

struct Refusal {
  base::ExitCode code;
  std::string text;
};

std::optional<Refusal> refusalOf(const std::string& text) {
  try {
    sensorsOf(text);
  } catch (const base::Error& error) {
    return Refusal{error.code(), error.what()};
  }
  return std::nullopt;
}

TEST(SensorSection, sensorsAreReadInTheOrderOfTheList) {
  const auto sensors = sensorsOf("[live]\nsensors = wheels, front\n" + kLaser +
                                 "clock = arrival\nclock_offset_s = -0.02\n[wheels]\ndriver = COdometryLines\n");
  ASSERT_EQ(sensors.size(), 2u);
  EXPECT_EQ(sensors[0].name, "wheels");
  EXPECT_EQ(sensors[0].driver, "COdometryLines");
  EXPECT_EQ(sensors[0].label, "");
  EXPECT_EQ(sensors[1].label, "LASER");
  EXPECT_EQ(sensors[1].options.clock, SensorOptions::Clock::arrival);
  EXPECT_EQ(sensors[1].options.clock_offset, -0.02);
  EXPECT_EQ(sensors[1].ini->read_string("front", "COM_port_LIN", ""), "/dev/ttyACM0");
}

TEST(SensorSection, whatIsMissingIsNamed) {
  auto refusal = refusalOf("[live]\n");
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, base::ExitCode::command_line);
  refusal = refusalOf("[live]\nsensors = rear\n" + kLaser);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, base::ExitCode::unknown_key);
  EXPECT_NE(refusal->text.find("[rear]"), std::string::npos) << refusal->text;
  refusal = refusalOf("[live]\nsensors = rear\n[rear]\nsensorLabel = x\n");
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("no key driver"), std::string::npos) << refusal->text;
  refusal = refusalOf("[live]\nsensors = front, rear\n" + kLaser +
                      "[rear]\ndriver = CHokuyoURG\nsensorLabel = LASER\nCOM_port_LIN = x\n");
  ASSERT_TRUE(refusal);
  EXPECT_NE(refusal->text.find("of another sensor"), std::string::npos) << refusal->text;
  refusal = refusalOf("[live]\nsensors = front\nlibraries = no_such_library.so\n" + kLaser);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, base::ExitCode::plugin_library);
}

TEST(SensorSection, aDriverThatIsNotThereIsNamed) {
  for (const char* driver : {"CNoSuchDriver", "CKinect"}) {
    const auto refusal = refusalOf("[live]\nsensors = eye\n[eye]\ndriver = " + std::string(driver) + "\n");
    ASSERT_TRUE(refusal) << driver;
    EXPECT_EQ(refusal->code, base::ExitCode::unknown_plugin);
    EXPECT_NE(refusal->text.find(driver), std::string::npos) << refusal->text;
  }
}

// MRPT's drivers ignore such keys.
TEST(SensorSection, keysThatADriverDoesNotReadAreNamed) {
  const auto unread = [](const std::string& keys) {
    return makeDriver(sensorsOf("[live]\nsensors = front\n" + kLaser + keys).at(0))->unreadKeys();
  };
  EXPECT_EQ(unread("pose_x = 0.1\nclock = driver\nCOM_port_WIN = COM3\nprocess_rate = 100\n"),
            std::vector<std::string>());
  EXPECT_EQ(unread("poze_z = 0.3\n"), std::vector<std::string>{"poze_z (did you mean pose_z?)"});
  EXPECT_EQ(unread("COM_prot_LIN = x\n"), std::vector<std::string>{"COM_prot_LIN (did you mean COM_port_LIN?)"});
}

TEST(SensorSection, aGrabberIniIsReadAsItIs) {
  const testing::ScratchFolder folder;
  std::ofstream(folder / "grabber.ini") << "[global]\nrawlog_prefix = ./dataset\n" + kLaser +
                                               "[unused]\nrawlog-grabber-ignore = true\ndriver = CNoSuchDriver\n";
  const auto sensors = sensorsOf("[live]\ngrabber = " + folder / "grabber.ini" + "\n");
  ASSERT_EQ(sensors.size(), 1u);
  EXPECT_EQ(sensors[0].name, "front");
  EXPECT_EQ(sensors[0].file, folder / "grabber.ini");
}

TEST(SensorSection, everyGrabberIniOfMrptIsRead) {
  const std::string folder = "/usr/share/mrpt/config_files/rawlog-grabber";
  if (!fs::exists(folder))
    GTEST_SKIP() << "the examples of rawlog-grabber (Debian's mrpt-common) are not on this machine";
  // Some drivers cannot be made without their hardware, or these INIs have keys that they do not read.
  const std::set<std::string> lasers{"CHokuyoURG", "CSickLaserSerial"};
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".ini") continue;
    std::vector<SensorSection> sensors;
    EXPECT_NO_THROW(sensors = readGrabberIni(entry.path().string())) << entry.path();
    for (const auto& sensor : sensors) {
      if (lasers.count(sensor.driver) == 0) continue;
      EXPECT_EQ(makeDriver(sensor)->unreadKeys(), std::vector<std::string>()) << entry.path();
    }
    ++count;
  }
  EXPECT_GT(count, 20);
}

}  // namespace
}  // namespace omnimapper::live::sensor_section_test
