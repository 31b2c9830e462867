#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

#include "CloseWindows.h"
#include "live_window/LiveWindow.h"

namespace live_window_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;

/// Set in the process that runs on its own display.
constexpr const char* kUnderDisplay = "OMNIMAPPER_TEST_UNDER_XVFB";

bool succeeds(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

/// Prints the output of the command, and runs it again if the virtual screen failed to start.
bool succeedsOnScreen(const std::string& command) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return false;
    std::string text;
    for (char part[256]; std::fgets(part, sizeof part, pipe);) text += part;
    const bool succeeded = ::pclose(pipe) == 0;
    std::fputs(text.c_str(), stdout);
    if (succeeded || text.find("xvfb-run: error") == std::string::npos) return succeeded;
  }
  return false;
}

/// Runs the test of that name again, by itself and on a virtual display. Returns true in the process that does the
/// work.
bool onDisplay() {
  return std::getenv(kUnderDisplay) != nullptr;
}

std::string rerunCommand() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  return std::string("env ") + kUnderDisplay + "=1 timeout 300 xvfb-run -a -s '-screen 0 1280x960x24' /proc/" +
         std::to_string(::getpid()) + "/exe --gtest_filter=" + info->test_suite_name() + "." + info->name();
}

#define RUN_UNDER_XVFB()                                                                               \
  if (!onDisplay()) {                                                                                  \
    if (!succeeds("which xvfb-run")) GTEST_SKIP() << "xvfb-run is not on this machine (package xvfb)"; \
    ASSERT_TRUE(succeedsOnScreen(rerunCommand())) << "run it alone: " << rerunCommand();               \
    return;                                                                                            \
  }

/// MRPT's window thread may still paint when a test is over and cannot be waited for. On its own display the process
/// therefore exits without destroying the objects that this thread uses.
class EndsAtOnce : public ::testing::EmptyTestEventListener {
  void OnTestProgramEnd(const ::testing::UnitTest& tests) override {
    if (!onDisplay()) return;
    std::fflush(nullptr);
    std::_Exit(tests.Passed() ? 0 : 1);
  }
};
const bool kEndsAtOnce = [] {
  ::testing::UnitTest::GetInstance()->listeners().Append(new EndsAtOnce);
  return true;
}();

/// Long enough for a busy machine.
void waitUntil(const std::function<bool()>& holds) {
  for (int i = 0; i < 1200 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

/// Number of pixels of the screen near a colour.
int pixelsNear(const mrpt::img::CImage& screen, int red, int green, int blue, int tolerance = 40) {
  int count = 0;
  for (unsigned y = 0; y < screen.getHeight(); ++y) {
    for (unsigned x = 0; x < screen.getWidth(); ++x) {
      count += std::abs(screen.at<std::uint8_t>(x, y, 2) - red) < tolerance &&
               std::abs(screen.at<std::uint8_t>(x, y, 1) - green) < tolerance &&
               std::abs(screen.at<std::uint8_t>(x, y, 0) - blue) < tolerance;
    }
  }
  return count;
}

mapper::PluginContext titled(const std::string& title) {
  mapper::PluginContext context;
  context.title = title;
  return context;
}

TEST(LiveWindow, showsGridPointsTrajectoryAndClosures) {
  RUN_UNDER_XVFB();
  if (!succeeds("which import")) GTEST_SKIP() << "import is not on this machine (package imagemagick)";
  ScratchFolder folder;
  plugins::LiveWindow window({}, titled("box"));
  ASSERT_TRUE(window.isOpen());
  EXPECT_TRUE(window.isLookedAt());
  window.keyFrameAdded(boxRun().view());  // no solve is needed
  const std::string file = folder / "screen.png";
  mrpt::img::CImage screen;
  const auto shown = [&] {
    return succeeds("import -window root " + file) && screen.loadFromFile(file) &&
           pixelsNear(screen, 37, 99, 235) > 50 && pixelsNear(screen, 22, 163, 74) > 30 &&
           pixelsNear(screen, 24, 33, 47) > 200 && pixelsNear(screen, 255, 255, 255, 2) > 50000;
  };
  waitUntil(shown);
  if (const char* keep = std::getenv("OMNIMAPPER_TEST_KEEP")) succeeds("cp " + file + " " + keep);
  EXPECT_GT(pixelsNear(screen, 37, 99, 235), 50) << "trajectory";
  EXPECT_GT(pixelsNear(screen, 22, 163, 74), 30) << "accepted closure";
  EXPECT_GT(pixelsNear(screen, 24, 33, 47), 200) << "points";
  EXPECT_GT(pixelsNear(screen, 255, 255, 255, 2), 50000) << "free floor";
}

TEST(LiveWindow, mayBeClosedAtAnyTimeAndTheRunGoesOn) {
  RUN_UNDER_XVFB();
  plugins::LiveWindowOptions options;
  plugins::LiveWindow window(options, titled("box"));
  RunRecord run = boxRun();
  window.update(run.view());
  waitUntil([&] { return x11::closeWindows("OmniMapper"), !window.isOpen(); });
  ASSERT_FALSE(window.isOpen());
  EXPECT_FALSE(window.isLookedAt());
  run.map.key_frames = {};
  window.update(run.view());
  window.finish(run.view());
}

TEST(LiveWindow, anEmptyMapIsNoError) {
  RUN_UNDER_XVFB();
  plugins::LiveWindow window({}, titled("nothing"));
  window.update(RunRecord().view());
  window.finish(RunRecord().view());
}

TEST(LiveWindow, withoutADisplayTheErrorNamesTheRemedy) {
  const std::string display = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  const std::string wayland = std::getenv("WAYLAND_DISPLAY") ? std::getenv("WAYLAND_DISPLAY") : "";
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  try {
    plugins::LiveWindow window({}, titled("box"));
    ADD_FAILURE() << "no error";
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::command_line);
    EXPECT_NE(std::string(error.what()).find("DISPLAY"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("xvfb-run"), std::string::npos) << error.what();
  }
  if (!display.empty()) ::setenv("DISPLAY", display.c_str(), 1);
  if (!wayland.empty()) ::setenv("WAYLAND_DISPLAY", wayland.c_str(), 1);
}

}  // namespace
}  // namespace live_window_test
