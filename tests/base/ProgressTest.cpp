#include <gtest/gtest.h>
#include <omnimapper/base/Progress.h>

#include <sstream>
#include <thread>

namespace omnimapper::base::progress_test {
namespace {

using namespace std::chrono_literals;

// Reports for slightly longer than the two seconds after which a line is drawn.
std::string shownFor(bool terminal, std::chrono::milliseconds how_long) {
  std::ostringstream out;
  {
    TerminalProgress progress(out, terminal);
    const auto end = std::chrono::steady_clock::now() + how_long;
    while (std::chrono::steady_clock::now() < end) {
      progress.report(0.25, "reading the log");
      std::this_thread::sleep_for(1ms);
    }
  }
  return out.str();
}

TEST(Progress, IsQuietWhenTheOutputIsNoTerminal) {
  EXPECT_EQ(shownFor(false, 2100ms), "");
}

TEST(Progress, IsQuietForShortWork) {
  EXPECT_EQ(shownFor(true, 50ms), "");
}

TEST(Progress, OnATerminalLongWorkShowsOneLineAndErasesItAtTheEnd) {
  const std::string shown = shownFor(true, 2350ms);
  EXPECT_NE(shown.find("25 %"), std::string::npos);
  EXPECT_NE(shown.find("reading the log"), std::string::npos);
  EXPECT_EQ(shown.find('\n'), std::string::npos);
  const std::string erase = "\r\033[K";
  EXPECT_EQ(shown.substr(shown.size() - erase.size()), erase);
  std::size_t redrawn = 0;
  for (auto at = shown.find(erase); at != std::string::npos; at = shown.find(erase, at + 1)) ++redrawn;
  EXPECT_GE(redrawn, 2u);
  EXPECT_LE(redrawn, 6u);  // 0.35 s at ten per second, the final erasing, and one more for a slow machine
}

TEST(Progress, TheDefaultSaysNothingAnywhere) {
  Progress progress;
  EXPECT_NO_THROW(progress.report(0.5, "anything"));
}

}  // namespace
}  // namespace omnimapper::base::progress_test
