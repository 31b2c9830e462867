#include "GrowingMap.h"

#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/derived/MapServer.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/map/Labels.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/map/MapFile.h>
#include <omnimapper/map/SessionMetrics.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace omnimapper::plugins {

namespace {

// Coarser than that of the finished map, whose grid is written once.
derived::ScanGridOptions gridOfPage() {
  derived::ScanGridOptions options;
  options.resolution = 0.1;
  options.max_cells = 4e6;
  return options;
}

std::string trajectoryText(const map::Map& map) {
  std::string text;
  for (const auto& frame : map.key_frames)
    text += geometry::tumLine(frame.stamp, geometry::fromMrpt(frame.map_from_base));
  return text;
}

}  // namespace

GrowingMap::GrowingMap(std::string folder) : folder_(std::move(folder)), grid_(gridOfPage()) {
  std::error_code error;  // one that the run will meet, too
  const auto hidden = std::filesystem::path(folder_).parent_path();
  if (std::filesystem::is_directory(hidden.parent_path(), error))
    is_mine_ = std::filesystem::create_directories(folder_, error);
}

GrowingMap::~GrowingMap() {
  if (!is_mine_) return;
  remove();
  std::error_code has_more;
  std::filesystem::remove(std::filesystem::path(folder_).parent_path(), has_more);
}

void GrowingMap::write(const mapper::State& state, const std::string& about) {
  std::filesystem::create_directories(folder_);
  writeGrid(state.map);
  derived::writeBytes(folder_ + "/trajectory.tum", trajectoryText(state.map));
  derived::writeBytes(folder_ + "/summary.json", about);
  map::MapFile file;
  for (const char* name : {building::kRoomsLayer, map::Labels::kLayer})
    if (const auto layer = state.map.layers.find(name)) file.set(map::layerToSection(name, *layer));
  file.set(map::layerToSection(map::Places::kLayer, map::LayerOf<map::Places>(derived::placesOf(state))));
  file.write(folder_ + "/checkpoint.omnimap");
}

void GrowingMap::writeGrid(const map::Map& map) {
  if (!grid_.update(map)) return;
  const auto grid = grid_.scanGrid();
  if (!grid) return;
  derived::writeBytes(folder_ + "/grid.pgm", derived::encodePgm(*grid));
  derived::writeBytes(folder_ + "/grid.yaml", derived::encodeMapServerYaml(*grid, "grid.pgm", grid->resolution));
}

std::string aboutRun(const mapper::View& view, const std::string& title) {
  using Json = nlohmann::ordered_json;
  Json about = {{"title", title}, {"sessions", Json::array()}};
  const auto metrics = map::sessionMetrics(view.map);
  for (const auto& session : view.map.sessions) {
    Json entry = {{"number", session.number}, {"title", session.title}, {"aligned", session.aligned}};
    for (const auto& of : metrics)
      if (of.number == session.number) {
        entry["key_frames"] = of.key_frames;
        entry["travel_m"] = of.travel;
        entry["log_s"] = of.seconds;
      }
    about["sessions"].push_back(std::move(entry));
  }
  if (!view.verdict.evidence.empty())
    about["verdict"] = {{"verdict", toString(view.verdict.answer)}, {"sentence", sentenceOf(view.verdict)}};
  if (view.live) {
    about["live"]["sensors"] = Json::array();
    for (const auto& sensor : view.live->sensors)
      about["live"]["sensors"].push_back(
          {{"name", sensor.name}, {"state", sensor.state}, {"observations", sensor.observations}});
  }
  return about.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

void GrowingMap::remove() {
  is_mine_ = false;
  // Renamed first, so that no server finds the folder without its map.
  const std::string removed = folder_ + "-removed";
  std::error_code ignored;
  std::filesystem::remove_all(removed, ignored);
  std::filesystem::rename(folder_, removed, ignored);
  std::filesystem::remove_all(removed, ignored);
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace omnimapper::plugins
