#include "ReportLandmarks.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/LabelColours.h>
#include <omnimapper/draw/Markup.h>

#include <algorithm>
#include <map>

#include "Chart.h"
#include "Html.h"

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kMostLandmarkRows = 200;

std::string swatch(const std::string& label) {
  const draw::Rgb colour = draw::colourOfLabel(label);
  return "<i class=\"swatch\" style=\"background:rgb(" + std::to_string(colour.r) + "," + std::to_string(colour.g) +
         "," + std::to_string(colour.b) + ")\"></i>";
}

std::string sensorsOf(const map::LandmarkShape& shape) {
  std::string text;
  for (const auto& [label, count] : shape.seen_by)
    text += (text.empty() ? "" : ", ") + draw::escapeMarkup(label) + " " + grouped(count);
  return text;
}

std::string photographOf(const map::LandmarkShape& shape) {
  const std::string address = derived::photographAddress(shape);
  return address.empty() ? "" : "<img class=\"photograph\" alt=\"\" src=\"" + address + "\"/>";
}

// The properties that the plugin gives, without those that have their own columns.
std::string otherProperties(const map::LandmarkShape& shape) {
  std::string text;
  for (const auto& property : shape.properties) {
    const std::string key = map::keyOf(property);
    if (key == "area_m2" || key == "length_m") continue;
    text += (text.empty() ? "" : ", ") + draw::escapeMarkup(key) + " " + draw::escapeMarkup(map::textOf(property));
  }
  return text;
}

std::string landmarkRow(const derived::ShapedLandmark& shaped, base::Stamp start) {
  const auto& [landmark, shape, moved] = shaped;
  const double area = derived::areaOf(shape), length = derived::lengthOf(shape);
  const auto since = [&](base::Stamp stamp) {
    return base::isValid(stamp) ? base::fixed(base::secondsBetween(start, stamp), 1) : "";
  };
  const auto middle = [&, &shape = shape](int axis) {
    return numberCell(shaped.isSomewhere() ? base::fixed(derived::referencePoint(shape)(axis), 2) : "");
  };
  return "<tr>" + numberCell(toString(landmark->id)) + cell(swatch(shape.label) + draw::escapeMarkup(shape.label)) +
         cell(draw::escapeMarkup(landmark->kind)) + middle(0) + middle(1) + middle(2) +
         numberCell(area > 0 ? base::fixed(area, 2) : "") + numberCell(length > 0 ? base::fixed(length, 2) : "") +
         numberCell(grouped(landmark->evidence)) + cell(sensorsOf(shape)) + numberCell(since(landmark->first_seen)) +
         numberCell(since(landmark->last_seen)) + cell(moved ? "moved" : "") + cell(photographOf(shape)) +
         cell(otherProperties(shape)) + "</tr>\n";
}

}  // namespace

std::string drawLandmarkTable(const std::vector<derived::ShapedLandmark>& landmarks, base::Stamp start) {
  if (landmarks.empty()) return {};
  std::vector<const derived::ShapedLandmark*> listed;
  for (const auto& landmark : landmarks) listed.push_back(&landmark);
  std::stable_sort(listed.begin(), listed.end(),
                   [](const auto* a, const auto* b) { return a->landmark->evidence > b->landmark->evidence; });
  std::string note;
  if (listed.size() > kMostLandmarkRows) {
    listed.resize(kMostLandmarkRows);
    note = "<p class=\"note\">" + grouped(kMostLandmarkRows) + " of " + grouped(landmarks.size()) +
           " landmarks are listed, those seen most often; " + grouped(landmarks.size() - kMostLandmarkRows) +
           " more are in the map.</p>";
  }
  std::string rows;
  for (const auto* landmark : listed) rows += landmarkRow(*landmark, start);
  return "<section class=\"card\"><h2>Landmarks</h2>" + note +
         "<div class=\"scroll tall\"><table class=\"sortable\" id=\"landmarks\"><thead><tr><th "
         "class=\"num\">landmark</th><th>label</th><th>kind</th><th class=\"num\">x [m]</th><th class=\"num\">y "
         "[m]</th><th class=\"num\">z [m]</th><th class=\"num\">area [m&#178;]</th><th class=\"num\">length "
         "[m]</th><th class=\"num\">measurements</th><th>seen by</th><th class=\"num\">first [s]</th><th "
         "class=\"num\">last [s]</th><th></th><th>photograph</th><th>other properties</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

std::string drawSensorBars(const std::vector<derived::ShapedLandmark>& landmarks) {
  std::map<std::string, std::size_t> counts;
  for (const auto& landmark : landmarks) ++counts[derived::sensorsText(landmark.shape.seen_by)];
  counts.erase("");
  std::vector<Bar> bars;
  for (const auto& [sensors, count] : counts) bars.push_back({sensors, static_cast<double>(count), grouped(count)});
  return drawBars("Landmarks by the sensors that saw them", bars);
}

std::string drawFeatureCurves(const mapper::View& view) {
  std::map<base::VariableId, std::size_t> key_frame_of_pose;
  for (std::size_t i = 0; i < view.map.key_frames.size(); ++i) key_frame_of_pose[view.map.key_frames[i].pose] = i;
  std::map<std::string, std::vector<double>> counts;  // by kind of factor, for each key frame
  for (const auto& [id, record] : view.graph.factors()) {
    if (!record.tags.landmark) continue;
    for (const auto variable : record.variables) {
      const auto pose = key_frame_of_pose.find(variable);
      if (pose == key_frame_of_pose.end()) continue;
      auto& of_kind = counts[std::string(record.factor->kind())];
      of_kind.resize(view.map.key_frames.size(), 0);
      ++of_kind[pose->second];
    }
  }
  Chart chart{"Landmarks measured from each key frame", "key frame", "", false, {}};
  for (auto& [kind, of_kind] : counts) {
    std::string name = kind;
    std::replace(name.begin(), name.end(), '_', ' ');
    constexpr int kColours = 4;
    ChartSeries series{name, 1 + static_cast<int>(chart.series.size()) % kColours, ChartSeries::Form::line, {}, {}};
    for (std::size_t i = 0; i < of_kind.size(); ++i) series.x.push_back(static_cast<double>(i));
    series.y = std::move(of_kind);
    chart.series.push_back(std::move(series));
  }
  return drawChart(chart);
}

}  // namespace omnimapper::plugins
