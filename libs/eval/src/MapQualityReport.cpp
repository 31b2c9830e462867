#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/MapQuality.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ReportLines.h"
#include "SurfacePlan.h"

namespace omnimapper::eval {

namespace {

using Json = nlohmann::ordered_json;
using surfaces::Surface;
using surfaces::SurfaceClass;
using surfaces::SurfaceSet;

std::string labelTable(const MapQuality& quality) {
  std::string text;
  for (const auto& [said, by_truth] : quality.labels) {
    const auto [right, all] = quality.rightOf(said);
    text += countLine("called " + toString(said), right, all);
    std::string others;
    for (const auto& [is, count] : by_truth)
      if (is != said) others += (others.empty() ? "" : ", ") + std::to_string(count) + " " + toString(is);
    if (!others.empty()) text += "      true class: " + others + "\n";
  }
  return text;
}

/// Error of a drawn surface that the plan shows in colour; of several errors the worst.
enum class Fault { none, wrong_class, doubled, spurious };

Fault faultOf(const JudgedSurface& judged, const MapQuality& quality, const SurfaceSet& map) {
  if (judged.is_spurious) return Fault::spurious;
  const bool is_doubled = std::any_of(quality.doubles.begin(), quality.doubles.end(), [&](const auto& pair) {
    return pair.first == judged.index || pair.second == judged.index;
  });
  if (is_doubled) return Fault::doubled;
  return map.surfaces[judged.index].is == *judged.true_class ? Fault::none : Fault::wrong_class;
}

const char* colourOf(Fault fault) {
  switch (fault) {
    case Fault::none:
      return "#15803d";
    case Fault::wrong_class:
      return "#d97706";
    case Fault::doubled:
      return "#2563eb";
    case Fault::spurious:
      break;
  }
  return "#dc2626";
}

void drawPlan(std::ostream& out, const std::string& title, const MapQuality& quality, const SurfaceSet& map,
              const SurfaceSet& truth) {
  SurfacePlan plan(out, title, {&map, &truth});
  plan.addLegend(colourOf(Fault::none), "right", 90);
  plan.addLegend(colourOf(Fault::wrong_class), "wrong class", 130);
  plan.addLegend(colourOf(Fault::doubled), "doubled", 110);
  plan.addLegend(colourOf(Fault::spurious), "on no true surface", 150);
  plan.addLegend("#000000", "seen but not in the map", 230);
  plan.addLegend("#d4d4d4", "true surface", 60);
  for (const auto& surface : truth.surfaces)
    if (surface.is != SurfaceClass::floor && surface.is != SurfaceClass::ceiling) plan.draw(surface, "#d4d4d4", 5);
  // Wrong surfaces are drawn over right ones.
  for (const Fault fault : {Fault::none, Fault::wrong_class, Fault::doubled, Fault::spurious}) {
    for (const auto& judged : quality.drawn) {
      if (faultOf(judged, quality, map) == fault) plan.draw(map.surfaces[judged.index], colourOf(fault), 2.5);
    }
  }
  for (const auto& sought : quality.sought)
    if (!sought.is_found) plan.draw(truth.surfaces[sought.index], "#000000", 1.5);
}

}  // namespace

std::string table(const MapQuality& quality) {
  std::string text = "surfaces of the map: " + std::to_string(quality.drawn.size()) + " drawn, " +
                     std::to_string(quality.candidates.size()) + " candidates (" +
                     std::to_string(quality.trueCandidates()) + " on true surfaces)\n";
  text += countLine("true surfaces that were seen, once in the map", quality.foundOnce(), quality.sought.size());
  text += countLine("  in the map at all", quality.found(), quality.sought.size());
  text += countLine("doubled pairs, relative to drawn surfaces", quality.doubles.size(), quality.drawn.size());
  text += countLine("drawn surfaces on no true surface", quality.spurious(), quality.drawn.size());
  text += line("outline, intersection over union (median)", base::fixed(quality.medianOverlap(), 3), "");
  text += countLine("drawn surfaces with the right class", quality.rightLabels(),
                    quality.drawn.size() - quality.spurious());
  text += labelTable(quality);
  text += "seen area that is in the map\n";
  for (const auto& [is, area] : quality.area)
    text += line(toString(is), percent(area.covered, area.seen), "of " + base::fixed(area.seen, 1) + " m^2");
  return text;
}

std::string json(const MapQuality& quality, const SurfaceSet& map, const SurfaceSet& truth) {
  Json areas = Json::object(), labels = Json::object(), drawn = Json::array(), sought = Json::array(),
       doubles = Json::array();
  for (const auto& [is, area] : quality.area)
    areas[toString(is)] = {{"seen_m2", area.seen}, {"covered_m2", area.covered}};
  for (const auto& [said, by_truth] : quality.labels)
    for (const auto& [is, count] : by_truth) labels[toString(said)][toString(is)] = count;
  for (const auto& one : quality.drawn) {
    const Surface& surface = map.surfaces[one.index];
    Json entry{{"name", surface.name},
               {"class", toString(surface.is)},
               {"area_m2", one.area},
               {"share_on_true", one.share_on_true},
               {"spurious", one.is_spurious}};
    if (one.true_class) entry["true_class"] = toString(*one.true_class);
    if (one.true_surface) entry["true_surface"] = truth.surfaces[*one.true_surface].name;
    if (one.overlap) entry["overlap"] = *one.overlap;
    drawn.push_back(std::move(entry));
  }
  for (const auto& one : quality.sought) {
    Json by = Json::array();
    for (const auto i : one.by) by.push_back(map.surfaces[i].name);
    sought.push_back({{"name", truth.surfaces[one.index].name},
                      {"class", toString(truth.surfaces[one.index].is)},
                      {"covered", one.covered},
                      {"found", one.is_found},
                      {"by", by}});
  }
  for (const auto& [a, b] : quality.doubles) doubles.push_back({map.surfaces[a].name, map.surfaces[b].name});
  const auto [wall_right, wall_all] = quality.rightOf(SurfaceClass::wall);
  return Json{{"metric", "surfaces of a map"},
              {"drawn", quality.drawn.size()},
              {"candidates", quality.candidates.size()},
              {"true_candidates", quality.trueCandidates()},
              {"sought", quality.sought.size()},
              {"found", quality.found()},
              {"found_once", quality.foundOnce()},
              {"doubled_pairs", quality.doubles.size()},
              {"spurious", quality.spurious()},
              {"median_overlap", quality.medianOverlap()},
              {"right_class", quality.rightLabels()},
              {"called_wall", wall_all},
              {"called_wall_right", wall_right},
              {"area", areas},
              {"labels", labels},
              {"true_surfaces", sought},
              {"drawn_surfaces", drawn},
              {"doubles", doubles}}
             .dump(1) +
         "\n";
}

void saveReport(const std::string& folder, const std::string& title, const MapQuality& quality, const SurfaceSet& map,
                const SurfaceSet& truth) {
  base::makeWritableFolder(folder);
  base::writeFile(folder + "/numbers.json", [&](std::ostream& out) { out << json(quality, map, truth); });
  base::writeFile(folder + "/plan.svg", [&](std::ostream& out) { drawPlan(out, title, quality, map, truth); });
  base::writeFile(folder + "/examples.csv", [&](std::ostream& out) { out << toCsv(examplesOf(quality, map)); });
}

}  // namespace omnimapper::eval
