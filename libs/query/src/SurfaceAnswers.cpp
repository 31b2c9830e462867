#include "SurfaceAnswers.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/query/Find.h>

#include <algorithm>

#include "Answers.h"
#include "FoundText.h"
#include "PlaceJson.h"
#include "PlaceText.h"

namespace omnimapper::query {

namespace {

using Lines = std::vector<std::vector<std::string>>;

// The value of a property, or a value of that type without meaning if the place does not have it.
template <class Value>
Value valueOf(const map::Place& place, const std::string& name) {
  for (const auto& property : place.properties)
    if (property.name == name)
      if (const auto* value = std::get_if<Value>(&property.value)) return *value;
  return {};
}

// The landmark on which it stands; empty if none is known.
std::string carrierOf(const map::Place& place) {
  return valueOf<std::string>(place, "on");
}

base::Stamp lastSeen(const map::Place& place) {
  return std::max(place.last_seen, valueOf<base::Stamp>(place, "last_seen_at"));
}

// When the place of a thing was in view last, be the thing there or not.
base::Stamp lastLooked(const map::Place& place) {
  return std::max(lastSeen(place), valueOf<base::Stamp>(place, "last_looked_at"));
}

std::vector<const map::Place*> thingsOn(const map::Place& surface, const MapToAsk& map) {
  std::vector<const map::Place*> things;
  for (const auto& place : map.places.places)
    if (hasId(surface, carrierOf(place))) things.push_back(&place);
  return things;
}

std::string imagesText(const map::Place& thing) {
  const auto count = [&](const char* name) { return std::to_string(valueOf<std::uint64_t>(thing, name)); };
  return count("seen_in") + " / " + count("hidden_in") + " / " + count("absent_in");
}

std::string whatIsOn(const map::Place& surface, const std::vector<const map::Place*>& things, base::Stamp looked) {
  std::string text = titleOf(surface) + " (" + toString(surface.id) + "), looked at last " + timeText(looked) + ": ";
  if (things.empty()) return text + "nothing was seen on it\n";
  const auto gone = std::count_if(things.begin(), things.end(), [](const auto* thing) { return thing->moved; });
  text += base::counted(things.size() - static_cast<std::size_t>(gone), "thing") +
          (gone > 0 ? ", " + std::to_string(gone) + " gone" : "") + "\n";
  Lines lines{
      {"name", "id", "x y [m]", "seen / hidden / absent in", "seen last (UTC)", "looked for last (UTC)", "state"}};
  for (const auto* thing : things)
    lines.push_back({titleOf(*thing), toString(thing->id), pointText(thing->position.head<2>()), imagesText(*thing),
                     timeText(lastSeen(*thing)), timeText(lastLooked(*thing)), thing->moved ? "gone" : "there"});
  return text + tableOf(lines);
}

}  // namespace

Answer answerLooked(const MapToAsk& map, const Request& request) {
  const std::string text = textOf(request);
  const Found found = find(map.places.places, text);
  Json document = answerTo("looked", map);
  document["text"] = text;
  document["surfaces"] = Json::array();
  document["closest"] = found.closest;
  if (found.places.empty()) return {nothingCalled(text, found), textOf(document), base::ExitCode::nothing_found};
  std::string said = foundLine(text, found);
  for (const auto& each : found.places) {
    const auto things = thingsOn(*each.place, map);
    base::Stamp looked = lastLooked(*each.place);
    Json json{{"match", toString(each.match.grade)}};
    json.update(jsonOf(*each.place, request.brief));
    json["things"] = Json::array();
    for (const auto* thing : things) {
      looked = std::max(looked, lastLooked(*thing));
      Json of_thing = jsonOf(*thing, request.brief);
      of_thing["last_looked"] = timeJson(lastLooked(*thing));
      json["things"].push_back(std::move(of_thing));
    }
    json["last_looked"] = timeJson(looked);
    said += whatIsOn(*each.place, things, looked);
    document["surfaces"].push_back(std::move(json));
  }
  return {said, textOf(document), base::ExitCode::ok};
}

Answer answerFindOn(const MapToAsk& map, const Request& request, const std::string& on) {
  const std::string text = textOf(request);
  const Found surfaces = find(map.places.places, on);
  std::vector<map::Place> there;
  for (const auto& place : map.places.places)
    if (!place.moved && std::any_of(surfaces.places.begin(), surfaces.places.end(),
                                    [&](const FoundPlace& each) { return hasId(*each.place, carrierOf(place)); }))
      there.push_back(place);
  const Found found = find(there, text);
  Json document = answerTo("find", map);
  document["text"] = text;
  document["on"] = on;
  document["matches"] = matchesJson(found, map, request.brief);
  document["closest"] = surfaces.places.empty() ? surfaces.closest : found.closest;
  if (surfaces.places.empty()) return {nothingCalled(on, surfaces), textOf(document), base::ExitCode::nothing_found};
  if (there.empty())
    return {"nothing is on '" + shownName(on) + "'\n", textOf(document), base::ExitCode::nothing_found};
  if (found.places.empty()) {
    const std::string said = "nothing on '" + shownName(on) + "' is called '" + shownName(text) +
                             "' or similarly; there are: " + namesText(there) + "\n";
    return {said, textOf(document), base::ExitCode::nothing_found};
  }
  Lines lines{placeHeads()};
  lines.front().emplace_back("on");
  for (const auto& each : found.places) {
    lines.push_back(cellsOf(*each.place));
    lines.back().push_back(carrierOf(*each.place));
  }
  const std::string which = surfaces.isOnlyNear() ? foundLine(on, surfaces) : "";
  return {which + foundLine(text, found) + tableOf(lines), textOf(document), base::ExitCode::ok};
}

}  // namespace omnimapper::query
