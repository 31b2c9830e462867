#include <gtest/gtest.h>
#include <omnimapper/base/Progress.h>

#include <sstream>
#include <thread>

namespace omnimapper::base::progress_test {
namespace {

using namespace std::chrono_literals;

const std::string kErase = "\r\033[K";

std::size_t drawn(const std::string& shown) {
  std::size_t lines = 0;
  for (auto at = shown.find(kErase); at != std::string::npos; at = shown.find(kErase, at + 1)) ++lines;
  return lines;
}

struct Shown {
  std::string text;
  std::chrono::duration<double> took;
};

// Reports for that long at least, and until the line has been drawn that many times. A line is drawn after two seconds.
Shown shownFor(bool terminal, std::chrono::milliseconds how_long, std::size_t lines = 0) {
  std::ostringstream out;
  const auto begin = std::chrono::steady_clock::now();
  {
    TerminalProgress progress(out, terminal);
    while (std::chrono::steady_clock::now() < begin + how_long || drawn(out.str()) < lines) {
      progress.report(0.25, "reading the log");
      std::this_thread::sleep_for(1ms);
    }
  }
  return {out.str(), std::chrono::steady_clock::now() - begin};
}

TEST(Progress, IsQuietWhenTheOutputIsNoTerminal) {
  EXPECT_EQ(shownFor(false, 2100ms).text, "");
}

TEST(Progress, IsQuietForShortWork) {
  auto shown = shownFor(true, 50ms);
  while (shown.took > 2s) shown = shownFor(true, 50ms);  // the machine was busy
  EXPECT_EQ(shown.text, "");
}

TEST(Progress, OnATerminalLongWorkShowsOneLineAndErasesItAtTheEnd) {
  const auto [shown, took] = shownFor(true, 2100ms, 3);
  EXPECT_NE(shown.find("25 %"), std::string::npos);
  EXPECT_NE(shown.find("reading the log"), std::string::npos);
  EXPECT_EQ(shown.find('\n'), std::string::npos);
  EXPECT_EQ(shown.substr(shown.size() - kErase.size()), kErase);
  EXPECT_GE(drawn(shown), 4u) << "with the final erasing";
  EXPECT_LE(double(drawn(shown)), 10 * (took.count() - 2) + 2) << "ten a second";
}

TEST(Progress, TheDefaultSaysNothingAnywhere) {
  Progress progress;
  EXPECT_NO_THROW(progress.report(0.5, "anything"));
}

}  // namespace
}  // namespace omnimapper::base::progress_test
