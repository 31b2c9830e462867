#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/drivers/KinectOptions.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

namespace omnimapper::drivers::kinect_options_test {
namespace {

KinectOptions read(const std::string& keys) {
  mrpt::config::CConfigFileMemory ini;
  ini.setContent("[kinect]\ndriver = KinectSensor\nsensorLabel = KINECT\nprocess_rate = 30\nclock = driver\n" + keys);
  return KinectOptions::read(ini, "kinect");
}

std::pair<base::ExitCode, std::string> refusalOf(const std::string& keys) {
  try {
    read(keys);
  } catch (const base::Error& error) {
    return {error.code(), error.what()};
  }
  return {base::ExitCode::ok, ""};
}

TEST(KinectOptions, anEmptySectionIsTheUsualDevice) {
  const auto options = read("");
  EXPECT_NEAR(options.depth_fx, 594.214, 0.001);
  EXPECT_NEAR(options.depth_k1, -0.26386, 0.00001);
  EXPECT_NEAR(options.picture_y, -0.025, 1e-12);
  EXPECT_EQ(options.registration, KinectOptions::Registration::ours);
  EXPECT_FALSE(options.tilt);
  EXPECT_TRUE(options.usesMotor());
  EXPECT_FALSE(read("grab_IMU = false\n").usesMotor());
}

TEST(KinectOptions, keysAreRead) {
  const auto options = read(
      "registration = none\npose_z = 1.1\npose_pitch = 10\ntilt_deg = -15\nled = green\nimu_rate_hz = 50\n"
      "picture_yaw_deg = -89\n");
  EXPECT_EQ(options.registration, KinectOptions::Registration::none);
  EXPECT_NEAR(options.baseFromSensor().z(), 1.1, 1e-12);
  EXPECT_NEAR(options.baseFromSensor().pitch(), 10 * M_PI / 180, 1e-12);
  EXPECT_NEAR(options.tilt.value_or(0), -15 * M_PI / 180, 1e-12);
  EXPECT_EQ(options.led, KinectOptions::Led::green);
  EXPECT_NEAR(options.picture_yaw, -89 * M_PI / 180, 1e-12);
}

TEST(KinectOptions, whatDoesNotFitIsNamedWithWhatDoes) {
  auto [code, text] = refusalOf("max_range_m = 20\n");
  EXPECT_EQ(code, base::ExitCode::out_of_range);
  EXPECT_NE(text.find("max_range_m = 20"), std::string::npos) << text;
  EXPECT_NE(text.find("13"), std::string::npos) << text;
  EXPECT_EQ(refusalOf("tilt_deg = 45\n").first, base::ExitCode::out_of_range);
  EXPECT_EQ(refusalOf("depth_fx_px = 0\n").first, base::ExitCode::out_of_range);
  EXPECT_EQ(refusalOf("inverse_depth_step_per_m = 0.003\n").first, base::ExitCode::out_of_range)
      << "a larger raw value is farther away";
  EXPECT_EQ(refusalOf("silence_s = soon\n").first, base::ExitCode::wrong_type);
  EXPECT_EQ(refusalOf("registration = theirs\n").first, base::ExitCode::wrong_type);
  std::tie(code, text) = refusalOf("device_numbr = 1\n");
  EXPECT_EQ(code, base::ExitCode::unknown_key);
  EXPECT_NE(text.find("did you mean device_number"), std::string::npos) << text;
}

TEST(KinectOptions, halfACalibrationIsRefused) {
  const auto [code, text] = refusalOf("depth_fx_px = 580\ndepth_fy_px = 580\ndepth_cx_px = 315\n");
  EXPECT_EQ(code, base::ExitCode::out_of_range);
  EXPECT_NE(text.find("no depth_cy_px"), std::string::npos) << text;
}

TEST(KinectOptions, aCalibrationWithoutALensHasNone) {
  const auto options =
      read("depth_fx_px = 580\ndepth_fy_px = 580\ndepth_cx_px = 315\ndepth_cy_px = 240\ndepth_k1 = 0.1\n");
  EXPECT_EQ(options.depth_k1, 0.1);
  EXPECT_EQ(options.depth_k2, 0) << "not the default device's";
  EXPECT_NE(options.picture_k1, 0) << "the other camera keeps its defaults";
  EXPECT_EQ(options.depthCamera().fx(), 580);
}

TEST(KinectOptions, theirPageHasAllOfThem) {
  std::ifstream file(testing::sourceFile("doc/live.md"));
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const auto& spec : KinectOptions::table().specs()) {
    std::string range;
    for (const char c : spec.range) range += c == '|' ? std::string("\\|") : std::string(1, c);
    const std::string row = "| `" + spec.key + "` | " + spec.default_value + " | " + range + " | " + spec.help + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace omnimapper::drivers::kinect_options_test
