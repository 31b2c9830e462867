#include "LandmarkLayers.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/draw/LabelColours.h>
#include <omnimapper/draw/Markup.h>

#include <map>

#include "Html.h"

namespace omnimapper::plugins {

namespace {

std::string cssColour(const draw::Rgb& colour) {
  return "rgb(" + std::to_string(colour.r) + "," + std::to_string(colour.g) + "," + std::to_string(colour.b) + ")";
}

std::string titleOf(const derived::ShapedLandmark& shaped) {
  const auto& [landmark, shape, moved] = shaped;
  std::string text = shape.label + " " + (shape.caption.empty() ? toString(landmark->id) : shape.caption) +
                     (moved ? " (moved)" : "") + ": " + base::counted(landmark->evidence, "measurement");
  for (const auto& property : shape.properties) text += "\n" + map::keyOf(property) + " " + map::textOf(property);
  for (const auto& [label, count] : shape.seen_by) text += "\nseen_by_" + label + " " + std::to_string(count);
  return "<title>" + draw::escapeMarkup(text) + "</title>";
}

std::string svgPathOf(const std::string& kind, const std::string& data) {
  return "<path class=\"" + kind + "\" d=\"" + data + "\"/>";
}

std::string svgOf(const derived::GridPicture& grid, const derived::ShapedLandmark& shaped) {
  const auto at = [&](const derived::PlanPoint& point) { return grid.pixelOf(point.x(), point.y()); };
  const derived::PlanShape plan = derived::fromAbove(shaped.shape);
  std::string paths;
  for (const auto& area : plan.areas) {
    std::vector<draw::PixelPoint> walk;
    for (const auto& corner : area) walk.push_back(at(corner));
    const char* kind = shaped.moved ? "moved" : draw::coversThePlan(shaped.shape.label) ? "area floor" : "area";
    paths += svgPathOf(kind, svgPath(walk) + "Z");
  }
  for (const auto& [from, to] : plan.lines)
    paths += svgPathOf(shaped.moved ? "moved" : "line", svgPath({at(from), at(to)}));
  std::vector<draw::PixelPoint> places;
  for (const auto& point : plan.points) {
    places.push_back(at(point));
    paths += svgPathOf("point", svgPath({places.back()}) + "h0");  // a line of zero length with round ends is a dot
  }
  if (!shaped.shape.caption.empty() && !places.empty()) {
    paths += "<text class=\"caption\" x=\"" + base::fixed(places.back().x + 6, 1) + "\" y=\"" +
             base::fixed(places.back().y + 4, 1) + "\">" + draw::escapeMarkup(shaped.shape.caption) + "</text>";
  }
  if (!shaped.shape.point_stamps.empty() && places.size() > 1) paths += svgPathOf("moved", svgPath(places));
  return paths.empty() ? "" : (shaped.isFaint() ? "<g class=\"faint\">" : "<g>") + titleOf(shaped) + paths + "</g>\n";
}

}  // namespace

std::vector<LandmarkLayer> landmarkLayers(const derived::GridPicture& grid,
                                          const std::vector<derived::ShapedLandmark>& landmarks) {
  std::map<std::pair<bool, std::string>, LandmarkLayer> by_label;
  for (const auto& landmark : landmarks) {
    const std::string& label = landmark.shape.label;
    LandmarkLayer& layer = by_label[{!draw::coversThePlan(label), label}];
    ++layer.count;
    layer.svg += svgOf(grid, landmark);
  }
  std::vector<LandmarkLayer> layers;
  for (auto& [key, layer] : by_label) {
    layer.label = key.second;
    layer.colour = cssColour(draw::colourOfLabel(layer.label));
    layer.name = "landmarks" + std::to_string(layers.size());
    layer.shown = key.first;
    layer.svg = "<g class=\"landmarks " + layer.name + "\" style=\"color:" + layer.colour +
                (layer.shown ? "" : ";display:none") + "\">\n" + layer.svg + "</g>\n";
    layers.push_back(std::move(layer));
  }
  return layers;
}

std::string svgPath(const std::vector<draw::PixelPoint>& walk) {
  std::string data;
  for (const draw::PixelPoint& point : walk)
    data += (data.empty() ? "M" : "L") + base::fixed(point.x, 1) + " " + base::fixed(point.y, 1);
  return data;
}

}  // namespace omnimapper::plugins
