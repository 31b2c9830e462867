#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/OutputFolder.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/query/MapDocument.h>
#include <omnimapper/query/MapGrid.h>
#include <omnimapper/server/ServedMap.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

namespace omnimapper::server {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr char kGrowingMap[] = "/checkpoint.omnimap";

/// What changes when a file is replaced.
std::string stampOf(const std::string& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return "missing";
  return std::to_string(found.st_ino) + " " + std::to_string(found.st_size) + " " +
         std::to_string(found.st_mtim.tv_sec) + "." + std::to_string(found.st_mtim.tv_nsec);
}

std::string pngOf(const query::GridMap& grid) {
  draw::PaletteImage image{grid.columns, grid.rows, {{128, 128, 128}, {255, 255, 255}, {0, 0, 0}}, {}};
  image.pixels.reserve(grid.cells.size());
  for (int row = grid.rows - 1; row >= 0; --row)
    for (int column = 0; column < grid.columns; ++column)
      image.pixels.push_back(static_cast<std::uint8_t>(grid.at({column, row})));
  return draw::encodePng(image);
}

Json placeOf(const query::GridMap& grid) {
  return {{"min_x_m", grid.map_from_grid.x},
          {"min_y_m", grid.map_from_grid.y},
          {"cell_m", grid.resolution},
          {"columns", grid.columns},
          {"rows", grid.rows}};
}

/// A grid is a part of the map only once a run has ended.
std::optional<query::GridMap> gridOf(const std::string& folder) {
  try {
    return query::readGrid(folder);
  } catch (const base::Error&) {
    return std::nullopt;
  }
}

/// The path of a file that a page may ask for; none if there is none.
std::optional<std::string> smallFile(const std::string& folder, const std::string& name) {
  constexpr std::uintmax_t kMost = std::uintmax_t{64} << 20;
  const std::string file = (fs::path(folder) / name).string();
  std::error_code missing;
  if (!fs::is_regular_file(file, missing) || fs::file_size(file, missing) > kMost) return std::nullopt;
  return file;
}

/// What changes when the files of the view in 3D are replaced; null if there are none.
Json solidOf(const std::string& folder) {
  std::string stamps;
  for (const char* name : {"points.ply", "landmarks.ply"}) {
    const auto file = smallFile(folder, name);
    if (file) stamps += std::string(name) + " " + stampOf(*file) + " ";
  }
  return stamps.empty() ? Json(nullptr) : Json(stamps);
}

/// The file of the picture of an object, by the id of its landmark; none if there is none.
std::optional<std::string> pictureFile(const std::string& folder, std::string id) {
  std::replace(id.begin(), id.end(), ':', '-');
  const fs::path file = fs::path(folder) / "objects" / (id + ".png");
  std::error_code none;
  return fs::is_regular_file(file, none) ? std::optional(file.string()) : std::nullopt;
}

// Lines of the TUM format: stamp x y z and a quaternion.
Json trajectoryOf(const std::string& folder) {
  const std::string file = (fs::path(folder) / "trajectory.tum").string();
  std::vector<std::array<double, 2>> path;
  if (std::error_code none; fs::exists(file, none)) {
    std::istringstream lines(base::readInput(file, "trajectory"));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream numbers(line);
      double stamp = 0, x = 0, y = 0;
      if (numbers >> stamp >> x >> y && std::isfinite(x) && std::isfinite(y)) path.push_back({x, y});
    }
  }
  const std::size_t step = path.size() / ServedMap::kMostPoses + 1;
  Json list = Json::array();
  for (std::size_t i = 0; i < path.size(); i += step)
    list.push_back({std::round(path[i][0] * 1000) / 1000, std::round(path[i][1] * 1000) / 1000});
  return list;
}

/// Why surfaces are called what they are called, by the ids of their landmarks: from surfaces.json of the run.
std::map<std::string, std::string> reasonsOf(const std::string& folder) {
  std::map<std::string, std::string> reasons;
  const auto file = smallFile(folder, "surfaces.json");
  const Json read = file ? Json::parse(base::readInput(*file, "surfaces"), nullptr, false) : Json();
  if (!read.is_object() || !read.contains("surfaces") || !read["surfaces"].is_array()) return reasons;
  for (const auto& surface : read["surfaces"])
    if (surface.is_object() && surface.contains("name") && surface["name"].is_string() && surface.contains("reason") &&
        surface["reason"].is_string())
      reasons[surface["name"].get<std::string>()] = surface["reason"].get<std::string>();
  return reasons;
}

// Whatever else a summary has, such as warnings with the names of files, is nothing for a page.
Json aboutOf(const std::string& folder) {
  Json about = Json::object();
  const auto file = smallFile(folder, "summary.json");
  if (!file) return about;
  const Json summary = Json::parse(base::readInput(*file, "summary"), nullptr, false);
  if (!summary.is_object()) return about;
  for (const char* key : {"title", "sessions", "verdict", "travel_m", "closures"})
    if (summary.contains(key)) about[key] = summary[key];
  if (summary.contains("live") && summary["live"].is_object() && summary["live"].contains("sensors"))
    about["sensors"] = summary["live"]["sensors"];
  return about;
}

}  // namespace

bool isGrowing(const query::MapToAsk& map) {
  return map.file.empty() || query::isCheckpoint(map.file);
}

ServedMap::ServedMap(std::string path, std::string growing) : path_(std::move(path)), growing_(std::move(growing)) {
  load();
}

bool ServedMap::update(std::string& warning) {
  const std::string now = stampOfRun() + stampOfFiles(*map_);
  if (now == stamp_) return false;
  try {
    load();
    return true;
  } catch (const base::Error& error) {
    stamp_ = now;
    warning = error.what();
    return false;
  }
}

std::string ServedMap::stampOfFiles(const query::MapToAsk& map) const {
  return stampOf(map.file) + stampOf((fs::path(map.folder) / "map.omnimap").string()) + solidOf(map.folder).dump();
}

/// What decides which map is served.
std::string ServedMap::stampOfRun() const {
  if (growing_.empty()) return "";
  return stampOf(growing_ + kGrowingMap) + stampOf(path_ + "/map.omnimap") + (isRunGoingOn() ? "growing" : "");
}

bool ServedMap::isRunGoingOn() const {
  std::error_code none;
  return !growing_.empty() && fs::exists(growing_, none);
}

// A map of before the run, which the run will replace, is not shown: who changed it would lose the change.
query::MapToAsk ServedMap::open() const {
  std::error_code none;
  if (growing_.empty()) return query::openMap(path_);
  if (fs::exists(growing_ + kGrowingMap, none)) return query::openMap(growing_);
  if (!isRunGoingOn() && fs::exists(path_ + "/map.omnimap", none)) return query::openMap(path_);
  query::MapToAsk nothing;
  nothing.folder = path_;
  return nothing;
}

void ServedMap::load() {
  std::string stamp = stampOfRun();  // before the map is opened: the run may end in the meantime
  auto map = open();
  stamp += stampOfFiles(map);
  const auto grid = gridOf(map.folder);
  Json document = Json::parse(query::mapDocument(map));
  document["revision"] = revision_ + 1;
  document["grid"] = grid ? placeOf(*grid) : Json(nullptr);
  document["solid"] = solidOf(map.folder);
  document["is_growing"] = isGrowing(map);
  const auto reasons = reasonsOf(map.folder);
  for (auto& place : document["places"]) {
    const auto id = place["id"].get<std::string>();
    place["has_picture"] = pictureFile(map.folder, id).has_value();
    const auto reason = reasons.find(id);
    place["why"] = reason == reasons.end() ? Json(nullptr) : Json(reason->second);
  }
  std::string trajectory = trajectoryOf(map.folder).dump() + "\n";
  std::string png = grid ? pngOf(*grid) : std::string();
  about_ = aboutOf(map.folder).dump() + "\n";
  map_ = std::make_shared<const query::MapToAsk>(std::move(map));
  document_ = document.dump() + "\n";
  grid_png_ = std::move(png);
  trajectory_ = std::move(trajectory);
  stamp_ = stamp;
  ++revision_;
}

std::optional<std::string> ServedMap::fileOfRun(const std::string& name) const {
  const auto file = smallFile(map_->folder, name);
  return file ? std::optional(base::committedPath(*file)) : std::nullopt;
}

std::optional<std::string> ServedMap::pictureOf(const std::string& id) const {
  const auto& places = map_->places.places;
  const auto place =
      std::find_if(places.begin(), places.end(), [&](const auto& each) { return toString(each.id) == id; });
  if (place == places.end()) return std::nullopt;
  const auto file = pictureFile(map_->folder, toString(place->id));
  return file ? std::optional(base::readInput(*file, "picture")) : std::nullopt;
}

}  // namespace omnimapper::server
