#include "pictures/Legend.h"

#include <mrpt/img/CImage.h>
#include <omnimapper/draw/Drawing.h>

#include <algorithm>

namespace omnimapper::exports {

namespace {

constexpr int kLetter = 6, kRow = 15, kLegendMargin = 6, kSwatch = 18;  // [px] of MRPT's font 6x13
constexpr draw::Rgb kLegendGround{255, 255, 255}, kLegendInk{20, 20, 20};

void drawText(draw::Image& picture, int left, int top, const std::string& text) {
  const int width = kLetter * static_cast<int>(text.size());
  mrpt::img::CImage written(width + kLetter, kRow, mrpt::img::CH_RGB);
  written.filledRectangle(0, 0, width + kLetter - 1, kRow - 1, mrpt::img::TColor(255, 255, 255));
  written.selectTextFont("6x13");
  written.textOut(0, 0, text, mrpt::img::TColor(0, 0, 0));
  for (int y = 0; y < kRow; ++y) {
    const auto* row = written.ptrLine<std::uint8_t>(static_cast<unsigned>(y));
    for (int x = 0; x < width; ++x) {
      if (row[3 * x] < 128) picture.at(left + x, top + y) = kLegendInk;
    }
  }
}

}  // namespace

void drawLegend(draw::Image& picture, const std::vector<LegendRow>& rows) {
  if (rows.empty()) return;
  std::size_t longest = 0;
  for (const auto& row : rows) longest = std::max(longest, row.text.size());
  const int width = 3 * kLegendMargin + kSwatch + kLetter * static_cast<int>(longest);
  const int height = 2 * kLegendMargin + kRow * static_cast<int>(rows.size());
  if (width > picture.width || 2 * height > picture.height) return;
  const int below = picture.height;
  picture.height += height;
  picture.pixels.resize(static_cast<std::size_t>(picture.width) * picture.height, kLegendGround);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int top = below + kLegendMargin + kRow * static_cast<int>(i);
    const double line = top + 0.5 * kRow;
    drawLine(picture, {kLegendMargin, line}, {kLegendMargin + kSwatch, line}, {rows[i].colour, 6});
    drawText(picture, 2 * kLegendMargin + kSwatch, top, rows[i].text);
  }
}

void drawLabel(draw::Image& picture, int left, int top, const std::string& text) {
  const int width = kLetter * static_cast<int>(text.size());
  if (text.empty() || width > picture.width || kRow > picture.height) return;
  left = std::clamp(left, 0, picture.width - width);
  top = std::clamp(top, 0, picture.height - kRow);
  const double x = left, y = top;
  fillAreas(picture, {{{x, y}, {x + width, y}, {x + width, y + kRow}, {x, y + kRow}}}, {kLegendGround, 0, 0.8});
  drawText(picture, left, top, text);
}

}  // namespace omnimapper::exports
