#include "SignDrawing.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Drawing.h>

#include <algorithm>
#include <string>

namespace omnimapper::pictures {

void drawSigns(draw::Image& picture, const obs::CObservationDoorSigns& found, std::vector<draw::LegendRow>& legend) {
  constexpr double kSure = 0.9;
  constexpr int kLine = 14;  // [px] distance between lines of text
  const draw::Rgb sure{20, 160, 40}, not_sure{230, 130, 0};
  const auto farthest = static_cast<float>(2 * std::max(picture.width, picture.height));
  std::size_t drawn = 0, read = 0;
  for (const auto& sign : found.signs) {
    const bool is_near =
        std::all_of(sign.corners_px.begin(), sign.corners_px.end(), [&](const Eigen::Vector2f& corner) {
          return corner.cwiseAbs().maxCoeff() < farthest;  // also false for NaN
        });
    if (!is_near) continue;
    ++drawn;
    const bool is_sure = std::any_of(sign.texts.begin(), sign.texts.end(),
                                     [](const obs::ReadText& text) { return text.confidence >= kSure; });
    read += is_sure;
    std::vector<draw::PixelPoint> outline;
    for (const auto& corner : sign.corners_px)
      outline.push_back({static_cast<double>(corner.x()) + 0.5, static_cast<double>(corner.y()) + 0.5});
    outline.push_back(outline.front());
    drawPath(picture, outline, {is_sure ? sure : not_sure, 3});
    int top = static_cast<int>(std::max(outline[2].y, outline[3].y)) + 4;
    for (const auto& text : sign.texts) {
      draw::drawLabel(picture, static_cast<int>(outline[3].x), top,
                      base::sensorName(text.text) + "  " + base::fixed(text.confidence, 2));
      top += kLine;
    }
  }
  if (read > 0) legend.push_back({sure, base::counted(read, "sign") + " with a certain text: outline, texts"});
  if (drawn > read) legend.push_back({not_sure, base::counted(drawn - read, "sign") + " without a certain text"});
}

}  // namespace omnimapper::pictures
