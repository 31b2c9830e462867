#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/TextDrawing.h>

#include <algorithm>
#include <fstream>

namespace text_drawing_test {
namespace {

using namespace omnimapper;
using sim::TextStyle;
using sim::Texture;

Texture whitePage(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * height, 255)};
}

// The rows and columns between which there is ink; the last ones are not included.
struct Ink {
  int left = 1 << 20, top = 1 << 20, right = 0, bottom = 0;
};
Ink inkOf(const Texture& page) {
  Ink ink;
  for (int y = 0; y < page.height; ++y) {
    for (int x = 0; x < page.width; ++x) {
      if (page.rgb[3 * (y * page.width + x)] > 128) continue;
      ink.left = std::min(ink.left, x), ink.right = std::max(ink.right, x + 1);
      ink.top = std::min(ink.top, y), ink.bottom = std::max(ink.bottom, y + 1);
    }
  }
  return ink;
}

TEST(TextDrawing, capitalsAreAsHighAsAskedAndStandOnTheBaseLine) {
  for (const double height : {12.0, 24.0, 61.0}) {
    TextStyle style;
    style.capital_height = height;
    Texture page = whitePage(400, 120);
    sim::drawText(page, "HEN", 20, 100, style);
    const Ink ink = inkOf(page);
    EXPECT_NEAR(ink.bottom - ink.top, height, 1) << height;
    EXPECT_NEAR(ink.bottom, 100, 1) << height;
    EXPECT_NEAR(ink.right - 20, sim::measureText("HEN", style).width, 0.15 * height) << height;
  }
}

TEST(TextDrawing, edgesAreSmoothAndPartsOutsideAreCutOff) {
  TextStyle style;
  Texture page = whitePage(60, 40);
  sim::drawText(page, "OSCAR", -20, 45, style);
  const auto greys = std::count_if(page.rgb.begin(), page.rgb.end(), [](int v) { return v > 30 && v < 220; });
  EXPECT_GT(greys, 50);
}

TEST(TextDrawing, linesAreAlignedAndApart) {
  TextStyle style;
  style.capital_height = 20;
  for (const auto& [alignment, left, right] :
       {std::tuple(sim::Alignment::left, 100, 0), {sim::Alignment::right, 0, 100}, {sim::Alignment::centre, 0, 0}}) {
    Texture page = whitePage(200, 100);
    const double last = sim::drawLines(page, {"HI", "HIM"}, 100, 10, alignment, style);
    EXPECT_DOUBLE_EQ(last, 10 + 20 + 32);
    const Ink ink = inkOf(page);
    EXPECT_NEAR(ink.top, 10, 1);
    EXPECT_NEAR(ink.bottom, last, 1);
    if (left != 0) {
      EXPECT_NEAR(ink.left, left, 4);
    }
    if (right != 0) {
      EXPECT_NEAR(ink.right, right, 4);
    }
    if (left == 0 && right == 0) {
      EXPECT_NEAR((ink.left + ink.right) / 2.0, 100, 2);
    }
  }
}

TEST(TextDrawing, lettersBeyondAsciiAreDrawn) {
  TextStyle style;
  Texture plain = whitePage(100, 80), dots = whitePage(100, 80);
  sim::drawText(plain, "U", 20, 70, style);
  sim::drawText(dots, "\xc3\x9c", 20, 70, style);
  EXPECT_LT(inkOf(dots).top, inkOf(plain).top - 4);
  EXPECT_EQ(inkOf(dots).bottom, inkOf(plain).bottom);
  EXPECT_THROW(sim::measureText("\xff\xfe", style), std::invalid_argument);
  EXPECT_THROW(sim::measureText("a\xc3", style), std::invalid_argument);
}

TEST(TextDrawing, aMissingFontIsAnErrorThatNamesIt) {
  TextStyle style;
  style.font_file = "/nowhere/Font.ttf";
  try {
    sim::measureText("a", style);
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("/nowhere/Font.ttf"), std::string::npos);
  }
  style.font_file = ::testing::TempDir() + "no_font.ttf";
  std::ofstream(style.font_file) << "not a font";
  EXPECT_THROW(sim::measureText("a", style), base::Error);
}

}  // namespace
}  // namespace text_drawing_test
