// MRPT's RawLogViewer draws what was perceived: seen on a screenshot.
#include <mrpt/img/CImage.h>

#include <cmath>

#include "PerceivedLog.h"

namespace {

using namespace perceived;

/// What is drawn in the 3D view of the screenshot, whose background is grey.
struct Drawn {
  int coloured = 0;       ///< pixels
  int colours = 0;        ///< hues, of twelve, that many of them have
  int lines_of_text = 0;  ///< rows of pixels with ink, in the window of text above
};

int hueOf(int red, int green, int blue) {
  const double alpha = red - 0.5 * (green + blue), beta = 0.5 * std::sqrt(3.) * (green - blue);
  return static_cast<int>(std::floor((std::atan2(beta, alpha) + M_PI) / (2 * M_PI) * 12)) % 12;
}

Drawn look(const mrpt::img::CImage& screen) {
  Drawn drawn;
  std::vector<int> of_hue(12, 0);
  for (unsigned y = 545; y < 795; ++y) {
    const auto* row = screen.ptrLine<std::uint8_t>(y);
    for (unsigned x = 408; x < 1268; ++x) {
      const int blue = row[3 * x], green = row[3 * x + 1], red = row[3 * x + 2];
      if (std::max({red, green, blue}) - std::min({red, green, blue}) < 40) continue;
      ++drawn.coloured;
      ++of_hue[static_cast<std::size_t>(hueOf(red, green, blue))];
    }
  }
  for (const int pixels : of_hue) drawn.colours += pixels > 100;
  for (unsigned y = 100; y < 495; ++y) {
    const auto* row = screen.ptrLine<std::uint8_t>(y);
    int ink = 0;
    for (unsigned x = 408; x < 1000; ++x) ink += row[3 * x] < 100;
    drawn.lines_of_text += ink > 20;
  }
  return drawn;
}

class RawLogViewer : public PerceivedHome {
 protected:
  void SetUp() override {
    if (omnimapper::testing::kIsSanitized)
      GTEST_SKIP() << "a stock tool cannot load a library that is built with a sanitizer";
    for (const char* program : {"RawLogViewer", "xvfb-run", "xdotool", "import"}) {
      if (!isInstalled(program)) GTEST_SKIP() << program << " is not on this machine (scripts/packages-test.txt)";
    }
  }
  Drawn show(const std::string& log) {
    const std::string picture = scratch_ / "screen.png", script = "tests/system/perceive/raw_log_viewer.sh";
    // With a home of its own: RawLogViewer keeps its settings there.
    const auto ended = runProgram({"env", "HOME=" + scratch_.path(), "xvfb-run", "-a", "-s", "-screen 0 1280x960x24",
                                   omnimapper::testing::sourceFile(script), OMNIMAPPER_OBS_LIBRARY, log, picture});
    EXPECT_EQ(ended.code, 0) << toString(ended);
    mrpt::img::CImage screen;
    if (!screen.loadFromFile(picture)) return {};
    if (const char* keep = std::getenv("OMNIMAPPER_TEST_KEEP"))
      fs::copy_file(picture, keep, fs::copy_options::overwrite_existing);
    return look(screen);
  }
};

TEST_F(RawLogViewer, DrawsPlanesOfASimulatedHome) {
  ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, derived_, {"--set", "perception.extractors=planes"})));
  const Drawn drawn = show(derived_);
  EXPECT_GT(drawn.coloured, 3000);
  EXPECT_GE(drawn.colours, 4);
  EXPECT_GT(drawn.lines_of_text, 50);
}

TEST_F(RawLogViewer, DrawsPlanesOfFreiburg1Rpy) {
  const auto folder = omnimapper::testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  importFirst(*folder, 10, "freiburg1", scratch_);
  ASSERT_TRUE(
      endedWith(ExitCode::ok, perceive(scratch_ / "raw.rawlog", derived_, {"--set", "perception.extractors=planes"})));
  const Drawn drawn = show(derived_);
  EXPECT_GT(drawn.coloured, 3000);
  EXPECT_GE(drawn.colours, 4);
  EXPECT_GT(drawn.lines_of_text, 50);
}

}  // namespace
