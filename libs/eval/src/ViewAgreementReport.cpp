#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/ViewAgreement.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "ReportLines.h"
#include "SurfacePlan.h"

namespace omnimapper::eval {

namespace {

using surfaces::SurfaceSet;

std::string metres(double value) {
  return base::fixed(value, 4) + " m";
}

std::string areaLine(const std::string& name, const AreaCoverage& area) {
  return line(name, percent(area.covered, area.seen), "of " + base::fixed(area.seen, 1) + " m^2");
}

nlohmann::ordered_json splitsJson(const std::vector<SplitSurface>& splits, const SurfaceSet& map) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& split : splits) {
    auto views = nlohmann::ordered_json::array({split.view});
    if (!split.other_view.empty()) views.push_back(split.other_view);
    all.push_back({{"surfaces", {map.surfaces[split.surfaces.first].name, map.surfaces[split.surfaces.second].name}},
                   {"views", views}});
  }
  return all;
}

nlohmann::ordered_json levelJson(const LevelPieces& level, const SurfaceSet& map) {
  auto names = nlohmann::ordered_json::array();
  for (const auto i : level.of_map) names.push_back(map.surfaces[i].name);
  return {{"area_m2", level.area},
          {"height_m", level.height},
          {"surfaces_of_map", names},
          {"planes_in_views", level.in_views}};
}

std::size_t middleOf(const std::vector<std::size_t>& sorted) {
  return sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

void drawViewPlan(std::ostream& out, const std::string& title, const ViewAgreement& agreement, const SurfaceSet& map) {
  constexpr char kRight[] = "#15803d", kDoubled[] = "#2563eb", kSplit[] = "#dc2626", kMissing[] = "#525252";
  constexpr char kSplitOfOne[] = "#d97706";
  // The area that was seen twice determines the size of the drawing, so that an empty map has one, too.
  SurfaceSet seen;
  for (const auto& one : agreement.seen) {
    auto& outline = seen.surfaces.emplace_back().parts.emplace_back().outline;
    const auto& cells = one.missing;
    for (int row = 0; row < cells.rows(); ++row)
      for (int column = 0; column < cells.columns(); ++column)
        if (cells.isSet({column, row})) outline.push_back(cells.middleOf({column, row}));
  }
  SurfacePlan plan(out, title, {&map, &seen});
  plan.addLegend(kRight, "agrees", 90);
  plan.addLegend(kMissing, "seen in two views but not in the map", 270);
  plan.addLegend(kDoubled, "doubled", 100);
  plan.addLegend(kSplitOfOne, "one in a single view, two in the map", 260);
  plan.addLegend(kSplit, "one in two views, two in the map", 250);
  for (const auto& one : agreement.seen) plan.draw(one.missing, kMissing);
  const auto draw = [&](std::size_t i, const char* colour) { plan.draw(map.surfaces[i], colour, 2.5); };
  for (std::size_t i = 0; i < map.surfaces.size(); ++i)
    if (!map.surfaces[i].is_candidate) draw(i, kRight);
  // Wrong surfaces are drawn over right ones.
  for (const auto& [a, b] : agreement.doubles) draw(a, kDoubled), draw(b, kDoubled);
  for (const auto& split : agreement.split_of_one)
    draw(split.surfaces.first, kSplitOfOne), draw(split.surfaces.second, kSplitOfOne);
  for (const auto& split : agreement.split) draw(split.surfaces.first, kSplit), draw(split.surfaces.second, kSplit);
}

}  // namespace

std::string table(const ViewAgreement& agreement) {
  std::string text = base::counted(agreement.views, "view") + ", " + base::counted(agreement.planes, "plane") +
                     " in them; " + std::to_string(agreement.drawn) + " surfaces drawn in the map\n";
  const auto count = [](std::size_t number) { return std::to_string(number); };
  text += line("split pairs: one in two views", count(agreement.split.size()), "");
  text += line("  one in a single view only", count(agreement.split_of_one.size()), "");
  text += countLine("doubled pairs, relative to drawn surfaces", agreement.doubles.size(), agreement.drawn);
  text += areaLine("area of planes in views that the map covers", agreement.area);
  text += areaLine("  of the area that two views show", agreement.area_twice);
  constexpr std::size_t kMostLevels = 3;
  for (std::size_t i = 0; i < std::min(kMostLevels, agreement.levels.size()); ++i) {
    const LevelPieces& level = agreement.levels[i];
    text += line(i == 0 ? "largest level surface, pieces in the map" : "next level surface, pieces in the map",
                 count(level.of_map.size()),
                 "of " + base::fixed(level.area, 1) + " m^2 at z = " + base::fixed(level.height, 2) + " m");
    text += line("  planes on it in a view, median", count(middleOf(level.in_views)),
                 "most " + count(level.in_views.empty() ? 0 : level.in_views.front()) + ", in " +
                     base::counted(level.in_views.size(), "view"));
  }
  text += line("distance of points from the map, median", metres(agreement.distance.median),
               "95 % " + metres(agreement.distance_95));
  text += countLine("  share of the points on planes", agreement.distance.count, agreement.points);
  return text;
}

std::string json(const ViewAgreement& agreement, const SurfaceSet& map) {
  using Json = nlohmann::ordered_json;
  Json doubles = Json::array();
  for (const auto& [a, b] : agreement.doubles) doubles.push_back({map.surfaces[a].name, map.surfaces[b].name});
  Json all{
      {"metric", "surfaces of a map against single views"},
      {"views", agreement.views},
      {"planes", agreement.planes},
      {"drawn", agreement.drawn},
      {"split_pairs", agreement.split.size()},
      {"split_pairs_of_one_view", agreement.split_of_one.size()},
      {"doubled_pairs", agreement.doubles.size()},
      {"area", {{"seen_m2", agreement.area.seen}, {"covered_m2", agreement.area.covered}}},
      {"area_of_two_views", {{"seen_m2", agreement.area_twice.seen}, {"covered_m2", agreement.area_twice.covered}}},
      {"distance_m",
       {{"median", agreement.distance.median},
        {"share_95", agreement.distance_95},
        {"points_on_the_map", agreement.distance.count},
        {"points", agreement.points}}}};
  Json& levels = all["level_surfaces"] = Json::array();
  for (const auto& level : agreement.levels) levels.push_back(levelJson(level, map));
  all["split"] = splitsJson(agreement.split, map);
  all["split_of_one_view"] = splitsJson(agreement.split_of_one, map);
  all["doubles"] = doubles;
  return all.dump(1) + "\n";
}

void saveReport(const std::string& folder, const std::string& title, const ViewAgreement& agreement,
                const SurfaceSet& map) {
  base::makeWritableFolder(folder);
  base::writeFile(folder + "/numbers.json", [&](std::ostream& out) { out << json(agreement, map); });
  base::writeFile(folder + "/plan.svg", [&](std::ostream& out) { drawViewPlan(out, title, agreement, map); });
}

}  // namespace omnimapper::eval
