#include "ReportMap.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/ScaleBar.h>
#include <omnimapper/draw/Markup.h>

#include <algorithm>
#include <cmath>

#include "DecisionText.h"
#include "Html.h"
#include "LandmarkLayers.h"
#include "MapPicture.h"

namespace omnimapper::plugins {

namespace {

std::string closureLine(const derived::GridPicture& grid, const derived::Closure& closure) {
  const draw::PixelPoint from = grid.pixelOf(closure.from.x, closure.from.y),
                         to = grid.pixelOf(closure.to.x, closure.to.y);
  const mapper::Decision& d = *closure.decision;
  return "<line x1=\"" + base::fixed(from.x, 1) + "\" y1=\"" + base::fixed(from.y, 1) + "\" x2=\"" +
         base::fixed(to.x, 1) + "\" y2=\"" + base::fixed(to.y, 1) + "\"><title>" +
         draw::escapeMarkup(d.kind + " " + toString(d.from) + " to " + toString(*d.to) + ": " + verdictText(d) + "\n" +
                            numbersText(d)) +
         "</title></line>\n";
}

std::string closureGroup(const derived::GridPicture& grid, const std::vector<derived::Closure>& closures, bool accepted,
                         std::size_t most) {
  std::string lines;
  for (const derived::Closure& closure : closures) {
    if (closure.decision->accepted != accepted) continue;
    if (most-- == 0) break;
    lines += closureLine(grid, closure);
  }
  return "<g class=\"" + std::string(accepted ? "accepted" : "refused") + "\">\n" + lines + "</g>\n";
}

std::string dot(const std::string& group, const char* kind, draw::PixelPoint at, double radius) {
  return "<circle class=\"" + group + " " + kind + "\" cx=\"" + base::fixed(at.x, 1) + "\" cy=\"" +
         base::fixed(at.y, 1) + "\" r=\"" + base::fixed(radius, 1) + "\"><title>" + kind + "</title></circle>\n";
}

/// The tracks of all sessions, those before the newest in a colour of their own.
std::string tracks(const std::vector<SessionPath>& paths, double radius) {
  std::string svg;
  for (const bool is_newest : {false, true}) {
    const std::string group = is_newest ? "track" : "earlier";
    std::string data, dots;
    for (const auto& path : paths) {
      if (path.is_newest != is_newest) continue;
      data += svgPath(path.points);
      dots += dot(group, "start", path.points.front(), radius) + dot(group, "end", path.points.back(), radius);
    }
    if (data.empty()) continue;
    svg += "<g class=\"" + group + "\"><path class=\"" + group + "\" d=\"" + data + "\"/>\n" + dots + "</g>\n";
  }
  return svg;
}

/// A scale bar of a round length in the lower left corner, about a sixth of the picture wide.
std::string scaleBar(const derived::GridPicture& grid) {
  const double length = derived::scaleBarLength(grid.image.width * grid.metres_per_pixel);
  const double size = std::max(grid.image.width, grid.image.height) / 50.0;
  const double x = size, y = grid.image.height - size, end = x + length / grid.metres_per_pixel;
  return "<path class=\"scale\" d=\"M" + base::fixed(x, 1) + " " + base::fixed(y - 0.4 * size, 1) + "V" +
         base::fixed(y, 1) + "H" + base::fixed(end, 1) + "V" + base::fixed(y - 0.4 * size, 1) +
         "\"/><text class=\"scale\" font-size=\"" + base::fixed(size, 1) + "\" text-anchor=\"middle\" x=\"" +
         base::fixed(0.5 * (x + end), 1) + "\" y=\"" + base::fixed(y - 0.5 * size, 1) + "\">" + base::brief(length) +
         " m</text>\n";
}

std::string toggle(const std::string& layer, const std::string& key, const std::string& label, bool on) {
  return "<label><input type=\"checkbox\" data-layer=\"" + layer + "\"" + (on ? " checked=\"\"" : "") + "/><i " + key +
         "></i>" + label + "</label>";
}

std::string legend(const std::vector<LandmarkLayer>& landmarks, const std::vector<derived::Closure>& closures,
                   std::size_t max_refused, std::size_t sessions) {
  const auto accepted = static_cast<std::size_t>(
      std::count_if(closures.begin(), closures.end(), [](const derived::Closure& c) { return c.decision->accepted; }));
  const std::size_t refused = closures.size() - accepted;
  std::string refused_label = "closures refused: " + grouped(refused);
  if (refused > max_refused) refused_label += " (" + grouped(max_refused) + " drawn)";
  std::string layers;
  for (const auto& layer : landmarks) {
    layers += toggle(layer.name, "style=\"color:" + layer.colour + "\"",
                     draw::escapeMarkup(layer.label) + ": " + grouped(layer.count), layer.shown);
  }
  return "<div class=\"toggles\">" +
         toggle("track", "class=\"kt\"", sessions > 1 ? "trajectory of the newest session" : "trajectory", true) +
         (sessions > 1 ? toggle("earlier", "class=\"ke\"", "earlier sessions: " + grouped(sessions - 1), true) : "") +
         toggle("accepted", "class=\"ka\"", "closures accepted: " + grouped(accepted), true) +
         toggle("refused", "class=\"kr\"", refused_label, true) + layers +
         "<span class=\"zoom\"><button data-zoom=\"0.7\" aria-label=\"closer\">+</button><button data-zoom=\"1.43\" "
         "aria-label=\"further\">&#8722;</button><button data-zoom=\"0\">whole map</button></span></div>";
}

}  // namespace

std::string drawReportMap(const derived::GridPicture& grid, const std::vector<derived::ShapedLandmark>& landmarks,
                          const std::vector<map::StampedPose>& trajectory,
                          const std::vector<derived::Closure>& closures, std::size_t max_refused) {
  const auto layers = landmarkLayers(grid, landmarks);
  const std::string width = std::to_string(grid.image.width), height = std::to_string(grid.image.height);
  const auto paths = simplifiedPaths(grid, trajectory, 0.3);
  const double radius = std::max(grid.image.width, grid.image.height) / 160.0;
  std::string svg = "<svg id=\"map\" viewBox=\"0 0 " + width + " " + height + "\" data-metres-per-pixel=\"" +
                    base::brief(grid.metres_per_pixel, 9) + "\" data-min-x=\"" + base::brief(grid.min_x, 9) +
                    "\" data-max-y=\"" + base::brief(grid.max_y, 9) +
                    "\" role=\"img\" aria-label=\"map from above\">\n<image width=\"" + width + "\" height=\"" +
                    height + "\" href=\"" + draw::pngAddress(draw::encodePng(grid.image)) + "\"/>\n";
  for (const auto& layer : layers) svg += layer.svg;
  svg += closureGroup(grid, closures, false, max_refused) + closureGroup(grid, closures, true, closures.size());
  svg += tracks(paths, radius) + scaleBar(grid) + "</svg>\n";
  return "<section class=\"card map\">" + legend(layers, closures, max_refused, paths.size()) + svg +
         "<p class=\"note\">x points right, y up. Ring: start; dot: end. Hold the pointer over a closure to see its "
         "reason, or over a landmark to see its properties. To zoom, use the buttons, or Ctrl and the mouse wheel; "
         "then drag.</p></section>\n";
}

}  // namespace omnimapper::plugins
