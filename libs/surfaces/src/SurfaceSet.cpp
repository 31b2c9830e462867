#include "omnimapper/surfaces/SurfaceSet.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

namespace omnimapper::surfaces {

namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector3d;

constexpr char kFormat[] = "omnimapper surfaces 1";
const std::array<const char*, 3> kOpeningKinds{"door", "passage", "window"};
const std::array<const char*, 3> kLeaves{"none", "open", "closed"};

// Rounded to the tenth of a millimetre, as no surface is known better.
Json toJson(const Vector3d& point) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4 + 0.0; };
  return {rounded(point.x()), rounded(point.y()), rounded(point.z())};
}

Json exactJson(const Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

template <class Points>
Json polygonJson(const Points& points) {
  Json polygon = Json::array();
  for (const Vector3d& point : points) polygon.push_back(toJson(point));
  return polygon;
}

// For each row, begin and length of each run of set cells, alternating.
Json toJson(const CellGrid& grid) {
  Json rows = Json::array();
  for (int row = 0; row < grid.rows(); ++row) {
    Json runs = Json::array();
    int begin = -1;
    for (int column = 0; column <= grid.columns(); ++column) {
      const bool is_set = column < grid.columns() && grid.isSet({column, row});
      if (is_set && begin < 0) begin = column;
      if (is_set || begin < 0) continue;
      runs.push_back(begin);
      runs.push_back(column - begin);
      begin = -1;
    }
    rows.push_back(std::move(runs));
  }
  return {{"origin", exactJson(grid.origin())}, {"u", exactJson(grid.u())},
          {"v", exactJson(grid.v())},           {"cell_m", grid.cell()},
          {"columns", grid.columns()},          {"rows", std::move(rows)}};
}

Json toJson(const Surface& surface) {
  Json json{{"id", surface.id}, {"name", surface.name}, {"class", toString(surface.is)}};
  if (!surface.body.empty()) json["body"] = surface.body;
  if (!surface.reason.empty()) json["reason"] = surface.reason;
  json["normal"] = exactJson(surface.plane.normal);
  json["distance_m"] = surface.plane.distance;
  json["area_m2"] = std::round(areaOf(surface) * 1e4) / 1e4;
  Json parts = Json::array();
  for (const FlatPart& part : surface.parts) {
    Json holes = Json::array();
    for (const auto& hole : part.holes) holes.push_back(polygonJson(hole));
    parts.push_back({{"outline", polygonJson(part.outline)}, {"holes", std::move(holes)}});
  }
  json["parts"] = std::move(parts);
  if (surface.is_moved) json["moved"] = true;
  if (surface.measurements > 0) json["measurements"] = surface.measurements;
  if (surface.is_candidate) json["candidate"] = true;
  if (surface.seen) json["seen"] = toJson(*surface.seen);
  return json;
}

constexpr double kDegrees = 180 / 3.14159265358979323846;  // per radian

Json toJson(const SurfaceSetLevel& level) {
  return {{"up", exactJson(level.up)},
          {"from", level.from},
          {"standard_deviation_deg", level.from == "unknown" ? Json() : Json(level.standard_deviation * kDegrees)}};
}

Json toJson(const Opening& opening) {
  Json json{{"name", opening.name},
            {"kind", kOpeningKinds.at(static_cast<std::size_t>(opening.kind))},
            {"rooms", {opening.rooms[0], opening.rooms[1]}},
            {"rectangle", polygonJson(opening.rectangle)},
            {"leaf", kLeaves.at(static_cast<std::size_t>(opening.leaf))}};
  if (opening.leaf == Opening::Leaf::none) return json;
  json["leaf_angle_rad"] = opening.leaf_angle;
  json["leaf_body"] = opening.leaf_body;
  return json;
}

Vector3d vectorFrom(const Json& json) {
  if (!json.is_array() || json.size() != 3) throw std::invalid_argument("a vector needs three numbers");
  const Vector3d vector(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
  if (!vector.allFinite()) throw std::invalid_argument("a number is not finite");
  return vector;
}

std::vector<Vector3d> polygonFrom(const Json& json) {
  std::vector<Vector3d> polygon;
  for (const auto& point : json) polygon.push_back(vectorFrom(point));
  return polygon;
}

CellGrid gridFrom(const Json& json) {
  const Json& rows = json.at("rows");
  const Vector3d u = vectorFrom(json.at("u")), v = vectorFrom(json.at("v"));
  constexpr double kNearly = 1e-3;
  if (std::abs(u.norm() - 1) > kNearly || std::abs(v.norm() - 1) > kNearly || std::abs(u.dot(v)) > kNearly)
    throw std::invalid_argument("u and v of the cells are not of length 1 and at right angles");
  CellGrid grid(vectorFrom(json.at("origin")), u, v, json.at("cell_m").get<double>(), json.at("columns").get<int>(),
                static_cast<int>(rows.size()));
  for (int row = 0; row < grid.rows(); ++row) {
    const Json& runs = rows[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i + 1 < runs.size(); i += 2) {
      const int begin = runs[i].get<int>(), length = runs[i + 1].get<int>();
      if (begin < 0 || length < 0 || length > grid.columns() - begin)
        throw std::invalid_argument("a run of cells leaves its row");
      for (int column = begin; column < begin + length; ++column) grid.set({column, row});
    }
  }
  return grid;
}

template <class Enum>
Enum choiceFrom(const Json& json, const std::array<const char*, 3>& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (json == names[i]) return static_cast<Enum>(i);
  throw std::invalid_argument("'" + json.get<std::string>() + "' is not known");
}

void refuseOffPlane(const geometry::Plane3& plane, const FlatPart& part) {
  constexpr double kOff = 0.01;  // [m]
  const auto isOff = [&](const Vector3d& corner) { return !(std::abs(signedDistance(plane, corner)) < kOff); };
  bool is_off = std::any_of(part.outline.begin(), part.outline.end(), isOff);
  for (const auto& hole : part.holes) is_off = is_off || std::any_of(hole.begin(), hole.end(), isOff);
  if (is_off) throw std::invalid_argument("a corner lies 1 cm or more off its plane");
}

SurfaceSetLevel levelFrom(const Json& json) {
  SurfaceSetLevel level{vectorFrom(json.at("up")), json.at("from").get<std::string>(), 0};
  if (std::abs(level.up.norm() - 1) > 1e-3) throw std::invalid_argument("up is not of length 1");
  const Json& sigma = json.at("standard_deviation_deg");
  if (sigma.is_number()) level.standard_deviation = sigma.get<double>() / kDegrees;
  return level;
}

Surface surfaceFrom(const Json& json) {
  Surface surface;
  surface.id = json.at("id").get<int>();
  surface.name = json.at("name").get<std::string>();
  const auto known = surfaceClassNamed(json.at("class").get<std::string>());
  if (!known) throw std::invalid_argument("class '" + json.at("class").get<std::string>() + "' is not known");
  surface.is = *known;
  surface.body = json.value("body", "");
  surface.reason = json.value("reason", "");
  surface.plane = {vectorFrom(json.at("normal")), json.at("distance_m").get<double>()};
  if (std::abs(surface.plane.normal.norm() - 1) > 1e-3) throw std::invalid_argument("the normal is not of length 1");
  for (const auto& part : json.at("parts")) {
    FlatPart& flat = surface.parts.emplace_back();
    flat.outline = polygonFrom(part.at("outline"));
    for (const auto& hole : part.at("holes")) flat.holes.push_back(polygonFrom(hole));
    refuseOffPlane(surface.plane, flat);
  }
  surface.is_moved = json.value("moved", false);
  // Files that were written before this key had its name say "sightings".
  surface.measurements = json.value("measurements", json.value("sightings", 0));
  surface.is_candidate = json.value("candidate", false);
  if (json.contains("seen")) surface.seen = gridFrom(json.at("seen"));
  return surface;
}

Opening openingFrom(const Json& json) {
  Opening opening;
  opening.name = json.at("name").get<std::string>();
  opening.kind = choiceFrom<Opening::Kind>(json.at("kind"), kOpeningKinds);
  opening.rooms = json.at("rooms").get<std::array<std::string, 2>>();
  const auto corners = polygonFrom(json.at("rectangle"));
  if (corners.size() != 4) throw std::invalid_argument("a rectangle has four corners");
  std::copy(corners.begin(), corners.end(), opening.rectangle.begin());
  opening.leaf = choiceFrom<Opening::Leaf>(json.at("leaf"), kLeaves);
  opening.leaf_angle = json.value("leaf_angle_rad", 0.0);
  opening.leaf_body = json.value("leaf_body", "");
  return opening;
}

}  // namespace

std::string toJson(const SurfaceSet& set) {
  const auto list = [](const auto& all) {
    Json lines = Json::array();
    for (const auto& one : all) lines.push_back(toJson(one));
    return lines;
  };
  // One surface per line, so that a person finds it and a file of thousands stays small.
  std::string text = "{\"format\": \"" + std::string(kFormat) +
                     "\",\n\"title\": " + Json(set.title).dump(-1, ' ', false, Json::error_handler_t::replace) +
                     (set.level ? ",\n\"frame\": \"map; metres\",\n\"level\": " + toJson(*set.level).dump() + ",\n"
                                : ",\n\"frame\": \"map, z up; metres\",\n");
  const auto append = [&](const char* name, const Json& lines, const char* end) {
    text += "\"" + std::string(name) + "\": [";
    for (std::size_t i = 0; i < lines.size(); ++i)
      text += (i > 0 ? ",\n" : "\n") + lines[i].dump(-1, ' ', false, Json::error_handler_t::replace);
    text += end;
  };
  append("surfaces", list(set.surfaces), "],\n");
  append("openings", list(set.openings), "]}\n");
  return text;
}

SurfaceSet readSurfaces(const std::string& file) {
  const auto refuse = [&](const std::string& what) -> base::Error {
    return {base::ExitCode::unreadable_input, file + ": " + what};
  };
  std::ifstream in(file);
  if (!in) throw refuse("cannot be opened; is the path right?");
  SurfaceSet set;
  std::string where = "the file";
  try {
    const Json json = Json::parse(in);
    if (json.at("format") != kFormat) throw std::invalid_argument("its format is not '" + std::string(kFormat) + "'");
    set.title = json.value("title", "");
    if (json.contains("level")) set.level = levelFrom(json.at("level"));
    for (const auto& surface : json.at("surfaces")) {
      where = "surface " + std::to_string(set.surfaces.size() + 1);
      set.surfaces.push_back(surfaceFrom(surface));
    }
    for (const auto& opening : json.at("openings")) {
      where = "opening " + std::to_string(set.openings.size() + 1);
      set.openings.push_back(openingFrom(opening));
    }
  } catch (const Json::exception& error) {
    throw refuse(where + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw refuse(where + ": " + error.what());
  }
  return set;
}

namespace {

double areaOf(const std::vector<Vector3d>& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]);
  return sum.norm() / 2;
}

}  // namespace

SurfaceSet moved(SurfaceSet set, const geometry::Se3& b_from_a) {
  const auto move = [&](auto& points) {
    for (Vector3d& point : points) point = b_from_a * point;
  };
  for (Surface& surface : set.surfaces) {
    surface.plane = b_from_a * surface.plane;
    for (FlatPart& part : surface.parts) {
      move(part.outline);
      for (auto& hole : part.holes) move(hole);
    }
    if (surface.seen) surface.seen = surface.seen->movedBy(b_from_a);
  }
  for (Opening& opening : set.openings) move(opening.rectangle);
  if (set.level) set.level->up = b_from_a.rotation * set.level->up;
  return set;
}

double areaOf(const Surface& surface) {
  double area = 0;
  for (const FlatPart& part : surface.parts) {
    area += areaOf(part.outline);
    for (const auto& hole : part.holes) area -= areaOf(hole);
  }
  return area;
}

std::vector<Vector3d> cornersOf(const Surface& surface) {
  std::vector<Vector3d> corners;
  for (const FlatPart& part : surface.parts) corners.insert(corners.end(), part.outline.begin(), part.outline.end());
  return corners;
}

}  // namespace omnimapper::surfaces
