#include "CorrectionAnswers.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <string>
#include <vector>

#include "Answers.h"
#include "PlaceText.h"

namespace omnimapper::query {

namespace {

bool isForbidden(const map::ClosedLoop& loop, const map::Corrections& corrections) {
  return std::any_of(corrections.forbidden.begin(), corrections.forbidden.end(),
                     [&](const auto& each) { return each.from == loop.from && each.to == loop.to; });
}

std::string coordinatesText(const Eigen::Vector2d& point) {
  return base::fixed(point.x(), 2) + " " + base::fixed(point.y(), 2);
}

}  // namespace

Json loopJson(const map::ClosedLoop& loop, const map::Corrections& corrections) {
  return {{"id", "loop " + toString(loop.from) + " " + toString(loop.to)},
          {"key_frames", {toString(loop.from), toString(loop.to)}},
          {"from_m", {loop.from_in_map.x(), loop.from_in_map.y()}},
          {"to_m", {loop.to_in_map.x(), loop.to_in_map.y()}},
          {"closed_by", loop.owner},
          {"why", loop.note},
          {"is_forbidden", isForbidden(loop, corrections)}};
}

Json deletedJson(const map::Corrections::DeletedThing& thing) {
  Json json = jsonOf(thing.place, true);
  json["who"] = thing.who;
  json["when"] = timeJson(thing.when);
  return json;
}

Answer answerLoops(const MapToAsk& map, const Request&) {
  Json document = answerTo("loops", map);
  document["loops"] = Json::array();
  std::vector<std::vector<std::string>> lines{{"from", "to", "at x y", "and x y", "closed by", "why", "forbidden"}};
  for (const auto& loop : map.loops) {
    document["loops"].push_back(loopJson(loop, map.corrections));
    lines.push_back({toString(loop.from), toString(loop.to), coordinatesText(loop.from_in_map),
                     coordinatesText(loop.to_in_map), shownName(loop.owner), shownName(loop.note),
                     isForbidden(loop, map.corrections) ? "yes" : "no"});
  }
  return {map.loops.empty() ? "the map rests on no loop closure\n" : tableOf(lines), textOf(document),
          base::ExitCode::ok};
}

Answer answerDeleted(const MapToAsk& map, const Request&) {
  Json document = answerTo("deleted", map);
  document["deleted"] = Json::array();
  std::vector<std::vector<std::string>> lines{{"landmark", "what", "by"}};
  for (const auto& thing : map.corrections.deleted) {
    document["deleted"].push_back(deletedJson(thing));
    lines.push_back({toString(thing.place.id), shownName(thing.place.label), shownName(thing.who)});
  }
  return {map.corrections.deleted.empty() ? "no landmark was deleted\n" : tableOf(lines), textOf(document),
          base::ExitCode::ok};
}

}  // namespace omnimapper::query
