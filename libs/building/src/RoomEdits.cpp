#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/building/RoomEdits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace omnimapper::building {

namespace {

using Json = nlohmann::ordered_json;
using Kind = RoomEdit::Kind;

constexpr char kEditsSchema[] = "omnimapper-room-edits";
constexpr int kEditsVersion = 1;
constexpr std::array<Kind, 5> kKinds{Kind::rename, Kind::merge, Kind::split, Kind::remove, Kind::move_door};

std::size_t pointsOf(Kind kind) {
  return kind == Kind::move_door ? 3 : kind == Kind::merge || kind == Kind::split ? 2 : 1;
}

Json placeJson(const Eigen::Vector2d& point) {
  const auto millimetres = [](double value) { return std::round(value * 1000) / 1000 + 0.0; };
  return Json::array({millimetres(point.x()), millimetres(point.y())});
}

Eigen::Vector2d placeOf(const Json& json) {
  const Eigen::Vector2d point(json.at(0).get<double>(), json.at(1).get<double>());
  if (!(point.cwiseAbs().maxCoeff() <= kFarthest)) throw std::out_of_range("a point is too far away");
  return point;
}

RoomEdit editOf(const Json& json) {
  const std::string name = json.at("edit");
  for (const Kind kind : kKinds) {
    if (name != toString(kind)) continue;
    RoomEdit edit{kind, json.value("name", ""), {}};
    for (const auto& point : json.at("points")) edit.points.push_back(placeOf(point));
    if (edit.points.size() != pointsOf(kind)) throw std::out_of_range(name + " with another number of points");
    return edit;
  }
  throw std::out_of_range("'" + base::printable(name.substr(0, 40)) + "' is no edit");
}

// Edits with what their place looked like, without those elsewhere.
Json setJson(const RoomEdits& edits) {
  Json json;
  json["edits"] = json["rooms"] = json["signs"] = Json::array();
  for (const auto& edit : edits.edits) {
    Json each{{"edit", toString(edit.kind)}};
    if (edit.kind == Kind::rename) each["name"] = edit.name;
    each["points"] = Json::array();
    for (const auto& point : edit.points) each["points"].push_back(placeJson(point));
    json["edits"].push_back(std::move(each));
  }
  for (const auto& outline : edits.outlines) {
    Json loop = Json::array();
    for (const auto& corner : outline) loop.push_back(placeJson(corner));
    json["rooms"].push_back(std::move(loop));
  }
  for (const auto& [text, place] : edits.signs)
    json["signs"].push_back({{"text", text}, {"position", placeJson(place)}});
  return json;
}

RoomEdits setOf(const Json& json) {
  RoomEdits edits;
  for (const auto& edit : json.at("edits")) edits.edits.push_back(editOf(edit));
  for (const auto& outline : json.at("rooms")) {
    auto& loop = edits.outlines.emplace_back();
    for (const auto& corner : outline) loop.push_back(placeOf(corner));
  }
  for (const auto& sign : json.at("signs")) edits.signs[sign.at("text")] = placeOf(sign.at("position"));
  return edits;
}

}  // namespace

std::string toString(Kind kind) {
  switch (kind) {
    case Kind::rename:
      return "rename";
    case Kind::merge:
      return "merge";
    case Kind::split:
      return "split";
    case Kind::remove:
      return "delete";
    case Kind::move_door:
      break;
  }
  return "move-door";
}

std::string toString(const RoomEdit& edit) {
  std::string text = toString(edit.kind);
  if (edit.kind == Kind::rename) text += " to '" + base::printable(edit.name) + "'";
  for (const auto& point : edit.points)
    text +=
        (&point == edit.points.data() ? " at " : ", ") + base::fixed(point.x(), 2) + " " + base::fixed(point.y(), 2);
  return text;
}

std::string encodeEdits(const RoomEdits& edits) {
  Json json{{"schema", kEditsSchema}, {"version", kEditsVersion}, {"frame", "map"}, {"unit", "m"}};
  json.update(setJson(edits));
  if (!edits.elsewhere.empty()) json["elsewhere"] = Json::array();
  for (const auto& others : edits.elsewhere) json["elsewhere"].push_back(setJson(others));
  return json.dump(1, ' ', true, Json::error_handler_t::replace) + "\n";
}

RoomEdits decodeEdits(const std::string& text, const std::string& what) {
  const auto refuse = [&](const std::string& reason) {
    throw base::Error(base::ExitCode::unreadable_input, what + ": " + reason);
  };
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object() || json.value("schema", Json()) != kEditsSchema)
    refuse("is no document of edits: it lacks \"schema\": \"" + std::string(kEditsSchema) +
           "\". Give the edits.json that omnimapper-rooms wrote.");
  if (json.value("version", Json()) != kEditsVersion)
    refuse("has another version than " + std::to_string(kEditsVersion) + ".");
  RoomEdits edits;
  try {
    edits = setOf(json);
    for (const auto& others : json.value("elsewhere", Json::array())) edits.elsewhere.push_back(setOf(others));
  } catch (const std::exception& error) {
    refuse(std::string("is damaged: ") + error.what() + ".");
  }
  return edits;
}

RoomEdits readEdits(const std::string& file) {
  return decodeEdits(base::readInput(file, "edits"), file);
}

RoomEdits moved(RoomEdits edits, const geometry::Se2& now_from_then) {
  const auto move = [&](Eigen::Vector2d& point) {
    point = (now_from_then * point).cwiseMax(-kFarthest).cwiseMin(kFarthest);
  };
  for (auto& edit : edits.edits) std::for_each(edit.points.begin(), edit.points.end(), move);
  for (auto& outline : edits.outlines) std::for_each(outline.begin(), outline.end(), move);
  for (auto& [text, place] : edits.signs) move(place);
  return edits;
}

RoomEdits anchoredTo(RoomEdits edits, const Storey& now, const std::map<std::string, Eigen::Vector2d>& signs) {
  edits.outlines.clear();
  for (const Room& room : now.rooms) edits.outlines.push_back(room.outline);
  edits.signs = signs;
  return edits;
}

std::map<std::string, Eigen::Vector2d> uniqueSigns(const std::vector<DoorSign>& signs) {
  std::map<std::string, Eigen::Vector2d> unique;
  std::map<std::string, int> counts;
  for (const DoorSign& sign : signs) {
    ++counts[sign.text];
    unique[sign.text] = sign.position;
  }
  for (const auto& [text, count] : counts)
    if (count > 1) unique.erase(text);
  return unique;
}

}  // namespace omnimapper::building
