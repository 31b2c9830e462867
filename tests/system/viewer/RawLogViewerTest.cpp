// MRPT's RawLogViewer draws derived observations, as screenshots of it show.
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/obs/IndexColour.h>

#include <cmath>

#include "../../obs/FilledObjects.h"
#include "../perceive/PerceiveRuns.h"

namespace {

using namespace perceived;
using mrpt::img::TColor;
using namespace omnimapper::obs;

/// A screenshot of RawLogViewer.
class Screen {
 public:
  explicit Screen(const mrpt::img::CImage& image) : image_(image) {}

  /// Number of pixels of the 3D view for which the condition holds.
  template <class Condition>
  int count(Condition holds) const {
    int pixels = 0;
    for (unsigned y = 545; y < 795; ++y) {
      for (unsigned x = 408; x < 1268; ++x) pixels += holds(at(x, y));
    }
    return pixels;
  }
  /// Number of pixels of a colour that nothing else in the view has. Thin lines are partly blended with the background.
  int of(const TColor& colour) const {
    const auto near = [](int a, int b) { return std::abs(a - b) < 5; };
    return count([&](const TColor& pixel) {
      return near(pixel.R, colour.R) && near(pixel.G, colour.G) && near(pixel.B, colour.B);
    });
  }
  /// Number of pixels that are clearly not grey, unlike the background.
  int coloured() const { return count(isColoured); }
  /// Number of hues, of twelve, that more than 100 pixels have.
  int hues() const {
    std::vector<int> of_hue(12, 0);
    count(
        [&](const TColor& pixel) { return isColoured(pixel) && ++of_hue[static_cast<std::size_t>(hueOf(pixel))] > 0; });
    return static_cast<int>(std::count_if(of_hue.begin(), of_hue.end(), [](int pixels) { return pixels > 100; }));
  }
  /// Number of rows of pixels that have text, in the window above the view.
  int rowsOfText() const {
    int rows = 0;
    for (unsigned y = 100; y < 495; ++y) {
      int ink = 0;
      for (unsigned x = 408; x < 1000; ++x) ink += at(x, y).B < 100;
      rows += ink > 20;
    }
    return rows;
  }

 private:
  TColor at(unsigned x, unsigned y) const {
    const auto* pixel = image_.ptrLine<std::uint8_t>(y) + 3 * x;
    return {pixel[2], pixel[1], pixel[0]};
  }
  static bool isColoured(const TColor& c) { return std::max({c.R, c.G, c.B}) - std::min({c.R, c.G, c.B}) >= 40; }
  static int hueOf(const TColor& c) {
    const double alpha = c.R - 0.5 * (c.G + c.B), beta = 0.5 * std::sqrt(3.) * (c.G - c.B);
    return static_cast<int>(std::floor((std::atan2(beta, alpha) + M_PI) / (2 * M_PI) * 12)) % 12;
  }

  mrpt::img::CImage image_;
};

class RawLogViewer : public PerceivedHome {
 protected:
  void SetUp() override {
    for (const char* program : {"RawLogViewer", "xvfb-run", "xdotool", "import", "convert", "pgrep"}) {
      if (!isInstalled(program)) GTEST_SKIP() << program << " is not installed (scripts/packages-test.txt)";
    }
  }

  /// A screenshot of RawLogViewer with one of the first 40 rows of a log selected. If OMNIMAPPER_TEST_KEEP names a
  /// folder, the picture is kept there.
  Screen show(const std::string& log, std::size_t row) {
    const std::string picture = scratch_ / "screen.png", script = "tests/system/viewer/raw_log_viewer.sh";
    // RawLogViewer keeps its settings in the home folder, so the test gives it another one. If the virtual screen does
    // not start, or the viewer cannot open its window on it, both are tried again.
    Ended ended;
    for (int attempt = 0; attempt < 3; ++attempt) {
      ended = runProgram(
          {"env", "HOME=" + scratch_.path(), "xvfb-run", "-a", "-s", "-screen 0 1280x960x24",
           omnimapper::testing::sourceFile(script), OMNIMAPPER_OBS_LIBRARY, log, std::to_string(row), picture},
          {400, 0});
      const auto says = [&](const char* words) { return ended.err.find(words) != std::string::npos; };
      if (!says("xvfb-run: error") && !says("before its window came")) break;
    }
    EXPECT_EQ(ended.code, 0) << toString(ended);
    mrpt::img::CImage image;
    if (!image.loadFromFile(picture)) image.resize(1280, 960, mrpt::img::CH_RGB);
    if (const char* keep = std::getenv("OMNIMAPPER_TEST_KEEP")) {
      const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
      fs::copy_file(picture, fs::path(keep) / (std::string(test->name()) + ".png"),
                    fs::copy_options::overwrite_existing);
    }
    return Screen(image);
  }

  /// Perceives the home with one extractor.
  void perceiveHome(const std::string& extractor, const Texts& more = {}) {
    Texts words{"--set", "perception.extractors=" + extractor};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_TRUE(endedWith(ExitCode::ok, perceive(kHome, derived_, words)));
  }

  /// Writes a log with this object alone.
  std::string logOf(const mrpt::serialization::CSerializable& object) {
    const std::string log = scratch_ / "one.rawlog";
    mrpt::io::CFileGZOutputStream out(log);
    mrpt::serialization::archiveFrom(out) << object;
    return log;
  }
};

/// The row of a log with the largest `size`, among those that the viewer shows without scrolling.
template <class Class, class Size>
std::size_t fullest(const Observations& log, Size size) {
  std::size_t best = 0, most = 0;
  for (std::size_t row = 0; row < std::min<std::size_t>(40, log.size()); ++row) {
    const auto observation = std::dynamic_pointer_cast<Class>(log[row]);
    if (!observation || size(*observation) <= most) continue;
    most = size(*observation);
    best = row;
  }
  EXPECT_GT(most, 0u);
  return best;
}

TEST_F(RawLogViewer, DrawsPlanesOfASimulatedHome) {
  perceiveHome("planes");
  const Screen screen = show(derived_, 5);
  EXPECT_GT(screen.coloured(), 3000);
  EXPECT_GE(screen.hues(), 4);
  EXPECT_GT(screen.rowsOfText(), 50);
}

TEST_F(RawLogViewer, DrawsPlanesOfFreiburg1Rpy) {
  const auto folder = omnimapper::testing::sharedData("rgbd/tum_fr1_rpy");
  OMNIMAPPER_NEEDS(folder);
  importFirst(*folder, 10, "freiburg1", scratch_);
  ASSERT_TRUE(
      endedWith(ExitCode::ok, perceive(scratch_ / "raw.rawlog", derived_, {"--set", "perception.extractors=planes"})));
  const Screen screen = show(derived_, 5);
  EXPECT_GT(screen.coloured(), 3000);
  EXPECT_GE(screen.hues(), 4);
  EXPECT_GT(screen.rowsOfText(), 50);
}

TEST_F(RawLogViewer, DrawsEachLineOfALaser) {
  perceiveHome("laser_lines");
  const auto log = readLog(derived_);
  const auto size = [](const CObservationLaserLines& found) { return found.lines.size(); };
  const auto row = fullest<CObservationLaserLines>(log, size);
  const auto count = size(dynamic_cast<const CObservationLaserLines&>(*log.at(row)));
  EXPECT_GE(count, 8u);
  const Screen screen = show(derived_, row);
  for (std::size_t i = 0; i < count; ++i) EXPECT_GT(screen.of(indexColour(i)), 20) << "line " << i;
  EXPECT_GT(screen.rowsOfText(), 50);
}

TEST_F(RawLogViewer, DrawsEachObjectAndItsName) {
  perceiveHome("planes", {"--set", "planes.class=ObjectExtractor"});
  const auto log = readLog(derived_);
  const auto size = [](const CObservationObjects& found) { return found.objects.size(); };
  const auto row = fullest<CObservationObjects>(log, size);
  const auto count = size(dynamic_cast<const CObservationObjects&>(*log.at(row)));
  EXPECT_GE(count, 4u);
  const Screen screen = show(derived_, row);
  for (std::size_t i = 0; i < count; ++i) EXPECT_GT(screen.of(indexColour(i)), 20) << "box of object " << i;
  EXPECT_GT(screen.coloured(), 2000);  // the points, in their own colours
}

TEST_F(RawLogViewer, DrawsACloudOfEdges) {
  perceiveHome("edges");
  const auto log = readLog(derived_);
  const auto row = fullest<mrpt::obs::CObservationPointCloud>(
      log, [](const mrpt::obs::CObservationPointCloud& cloud) { return cloud.pointcloud->size(); });
  EXPECT_NE(log.at(row)->sensorLabel.find(".edges."), std::string::npos);
  // MRPT's own drawing of clouds is black; axes are grey with white numbers.
  EXPECT_GT(show(derived_, row).of({0, 0, 0}), 2000);
}

TEST_F(RawLogViewer, DrawsSignsOfDoors) {
  const auto signs = filledSigns();
  const Screen screen = show(logOf(*signs), 0);
  for (std::size_t i = 0; i < signs->signs.size(); ++i)
    EXPECT_GT(screen.of(indexColour(i)), 20) << "ray and frame of sign " << i;
  EXPECT_GT(screen.of({250, 250, 250}), 100) << "the patch";
  EXPECT_GT(screen.of({200, 20, 20}), 20) << "the bar along its top";
}

TEST_F(RawLogViewer, DrawsAMotion) {
  EXPECT_GT(show(logOf(*filledMotion()), 0).coloured(), 2000);
}

}  // namespace
