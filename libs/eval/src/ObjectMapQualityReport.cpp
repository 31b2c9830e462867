#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/ObjectMapQuality.h>
#include <omnimapper/eval/Statistics.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace omnimapper::eval {

namespace {

using Is = JudgedObject::Is;
using State = MappedObject::State;

constexpr double kMillimetres = 1000;

std::string cells(const std::string& name, const std::string& images, const std::string& in_map,
                  const std::string& error, const std::string& extent, const std::string& median,
                  const std::string& nine_tenths) {
  char row[400];
  std::snprintf(row, sizeof row, "  %-24s %7s  %-16s %9s %8s %9s %9s\n", name.c_str(), images.c_str(), in_map.c_str(),
                error.c_str(), extent.c_str(), median.c_str(), nine_tenths.c_str());
  return row;
}

// The names of mapped objects of which `counts` holds, separated by blanks.
template <class Counts>
std::vector<std::string> namesWhere(const ObjectMapQuality& quality, const ObjectMap& map, const Counts& counts) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    if (counts(quality.judged[i], map.objects[i])) names.push_back(map.objects[i].id);
  }
  return names;
}

std::vector<std::string> presentThatAre(Is is, const ObjectMapQuality& quality, const ObjectMap& map) {
  return namesWhere(quality, map, [&](const JudgedObject& judged, const MappedObject& object) {
    return object.state == State::present && judged.is == is;
  });
}

std::vector<std::string> statesThatAre(bool right, const ObjectMapQuality& quality, const ObjectMap& map) {
  return namesWhere(quality, map, [&](const JudgedObject& judged, const MappedObject&) {
    return judged.state_is_right && *judged.state_is_right == right;
  });
}

std::vector<std::string> inState(State state, const ObjectMap& map) {
  std::vector<std::string> names;
  for (const MappedObject& object : map.objects) {
    if (object.state == state) names.push_back(object.id);
  }
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text = std::to_string(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? ": " : " ") + names[i];
  return text;
}

// The values of the first mapped object of each sought one that was found.
std::vector<double> ofFound(const ObjectMapQuality& quality, double JudgedObject::*value) {
  std::vector<double> values;
  for (const SoughtObject& sought : quality.sought) {
    if (!sought.by.empty()) values.push_back(quality.judged[sought.by.front()].*value);
  }
  return values;
}

std::string rowOf(const SoughtObject& sought, const ObjectMapQuality& quality, const ObjectMap& map,
                  const ObjectTruth& truth) {
  const std::string &name = truth.objects[sought.object].name, images = std::to_string(sought.images);
  if (sought.by.empty()) return cells(name, images, "missed", "-", "-", "-", "-");
  std::string ids;
  for (const std::size_t i : sought.by) ids += (ids.empty() ? "" : " ") + map.objects[i].id;
  const JudgedObject& first = quality.judged[sought.by.front()];
  return cells(name, images, ids, base::fixed(first.position_error * kMillimetres, 0) + " mm",
               base::fixed(100 * first.extent, 0) + " %", base::fixed(first.distance_median * kMillimetres, 1) + " mm",
               base::fixed(first.distance_90 * kMillimetres, 1) + " mm");
}

}  // namespace

std::string table(const ObjectMapQuality& quality, const ObjectMap& map, const ObjectTruth& truth) {
  const auto present = inState(State::present, map).size();
  std::string text = std::to_string(quality.found()) + " of " + base::counted(quality.sought.size(), "object") +
                     " that were seen often enough are in the map, " + std::to_string(quality.doubled()) +
                     " of them more than once\n";
  text += cells("object", "images", "in the map as", "position", "extent", "median", "90 %");
  for (const SoughtObject& sought : quality.sought) text += rowOf(sought, quality, map, truth);
  text += "of " + base::counted(present, "present object") + ", on furniture, walls or floor " +
          listed(presentThatAre(Is::furniture, quality, map)) + "; on nothing true " +
          listed(presentThatAre(Is::nothing, quality, map)) + "\n";
  text += "present or gone: right " + std::to_string(statesThatAre(true, quality, map).size()) + ", wrong " +
          listed(statesThatAre(false, quality, map)) + "; gone " + listed(inState(State::gone, map)) + "\n";
  if (map.merged) text += "merged into others: " + std::to_string(*map.merged) + "\n";
  return text;
}

std::string json(const ObjectMapQuality& quality, const ObjectMap& map, const ObjectTruth& truth) {
  using Json = nlohmann::ordered_json;
  const auto median = [&](double JudgedObject::*value) { return statisticsOf(ofFound(quality, value)).median; };
  Json each = Json::array();
  for (const SoughtObject& sought : quality.sought) {
    Json ids = Json::array();
    for (const std::size_t i : sought.by) ids.push_back(map.objects[i].id);
    Json entry{{"object", truth.objects[sought.object].name}, {"images", sought.images}, {"in_map", ids}};
    if (!sought.by.empty()) {
      const JudgedObject& first = quality.judged[sought.by.front()];
      entry["position_error_m"] = first.position_error;
      entry["extent"] = first.extent;
      entry["distance_median_m"] = first.distance_median;
      entry["distance_90_m"] = first.distance_90;
    }
    each.push_back(std::move(entry));
  }
  const Json all{{"sought", quality.sought.size()},
                 {"found", quality.found()},
                 {"doubled", quality.doubled()},
                 {"present", inState(State::present, map).size()},
                 {"on_furniture", presentThatAre(Is::furniture, quality, map)},
                 {"on_nothing", presentThatAre(Is::nothing, quality, map)},
                 {"gone", inState(State::gone, map)},
                 {"states_right", statesThatAre(true, quality, map).size()},
                 {"states_wrong", statesThatAre(false, quality, map)},
                 {"merged", map.merged ? Json(*map.merged) : Json()},
                 {"position_error_median_m", median(&JudgedObject::position_error)},
                 {"extent_median", median(&JudgedObject::extent)},
                 {"distance_median_m", median(&JudgedObject::distance_median)},
                 {"distance_90_m", median(&JudgedObject::distance_90)},
                 {"each", std::move(each)}};
  return all.dump(2) + "\n";
}

std::string curveTable(const ObjectMapQuality& quality) {
  std::string text = "images,objects,precision,recall\n";
  char row[100];
  for (const ObjectCurvePoint& point : quality.curve) {
    std::snprintf(row, sizeof row, "%d,%zu,%.4f,%.4f\n", point.images, point.objects, point.precision, point.recall);
    text += row;
  }
  return text;
}

}  // namespace omnimapper::eval
