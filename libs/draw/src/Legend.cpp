#include <mrpt/img/CImage.h>
#include <omnimapper/draw/Drawing.h>
#include <omnimapper/draw/Legend.h>

#include <algorithm>

namespace omnimapper::draw {

namespace {

constexpr int kLetter = 6, kRow = 15, kLegendMargin = 6, kSwatch = 18;  // [px] of MRPT's font 6x13
constexpr Rgb kLegendGround{255, 255, 255}, kLegendInk{20, 20, 20};

void drawText(Image& picture, int left, int top, const std::string& text, int scale = 1) {
  const int width = kLetter * static_cast<int>(text.size());
  mrpt::img::CImage written(width + kLetter, kRow, mrpt::img::CH_RGB);
  written.filledRectangle(0, 0, width + kLetter - 1, kRow - 1, mrpt::img::TColor(255, 255, 255));
  written.selectTextFont("6x13");
  written.textOut(0, 0, text, mrpt::img::TColor(0, 0, 0));
  for (int y = 0; y < scale * kRow; ++y) {
    const auto* row = written.ptrLine<std::uint8_t>(static_cast<unsigned>(y / scale));
    for (int x = 0; x < scale * width; ++x) {
      if (row[3 * (x / scale)] < 128) picture.at(left + x, top + y) = kLegendInk;
    }
  }
}

}  // namespace

void drawLegend(Image& picture, const std::vector<LegendRow>& rows, int columns, int scale) {
  if (rows.empty()) return;
  std::size_t longest = 0;
  for (const auto& row : rows) longest = std::max(longest, row.text.size());
  const int margin = scale * kLegendMargin, swatch = scale * kSwatch, row_height = scale * kRow;
  const int width = 3 * margin + swatch + scale * kLetter * static_cast<int>(longest);
  const int all = static_cast<int>(rows.size());
  columns = std::clamp(picture.width / width, 1, std::min(columns, all));
  const int in_column = (all + columns - 1) / columns;
  const int height = 2 * margin + row_height * in_column;
  if (width > picture.width || 2 * height > picture.height) return;
  const int below = picture.height;
  picture.height += height;
  picture.pixels.resize(static_cast<std::size_t>(picture.width) * picture.height, kLegendGround);
  for (int i = 0; i < all; ++i) {
    const int left = margin + width * (i / in_column), top = below + margin + row_height * (i % in_column);
    const auto& row = rows[static_cast<std::size_t>(i)];
    const double line = top + 0.5 * row_height, x = left;
    drawLine(picture, {x, line}, {x + swatch, line}, {row.colour, 6.0 * scale});
    drawText(picture, left + margin + swatch, top, row.text, scale);
  }
}

void drawLabel(Image& picture, int left, int top, const std::string& text) {
  const int width = kLetter * static_cast<int>(text.size());
  if (text.empty() || width > picture.width || kRow > picture.height) return;
  left = std::clamp(left, 0, picture.width - width);
  top = std::clamp(top, 0, picture.height - kRow);
  const double x = left, y = top;
  fillAreas(picture, {{{x, y}, {x + width, y}, {x + width, y + kRow}, {x, y + kRow}}}, {kLegendGround, 0, 0.8});
  drawText(picture, left, top, text);
}

}  // namespace omnimapper::draw
