#include "FoundText.h"

#include <omnimapper/base/Numbers.h>

#include <algorithm>

#include "PlaceText.h"
#include "Target.h"

namespace omnimapper::query {

namespace {

constexpr std::size_t kMostListed = 20;

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
    text += (text.empty() ? "'" : ", '") + shownName(names[i]) + "'";
  return text + (names.size() > kMostListed ? ", ..." : "");
}

std::vector<std::string> distinctNames(const Found& found) {
  std::vector<std::string> names;
  for (const auto& each : found.places)
    if (std::find(names.begin(), names.end(), each.match.name) == names.end()) names.push_back(each.match.name);
  return names;
}

}  // namespace

std::string nothingCalled(const std::string& text, const Found& found) {
  const std::string nothing = "nothing is called '" + shownName(text) + "' or similarly";
  if (found.closest.empty()) return nothing + "; omnimapper-query MAP list shows what there is\n";
  return nothing + "; closest: " + listed(found.closest) + "\n";
}

std::string foundLine(const std::string& text, const Found& found) {
  if (found.isOnlyNear())
    return "nothing is called '" + shownName(text) + "'; nearest: " + listed(distinctNames(found)) + "\n";
  return "'" + shownName(text) + "' fits " + base::counted(found.places.size(), "landmark") +
         (found.places.size() > 1 ? ", all listed\n" : "\n");
}

Json matchesJson(const Found& found, const MapToAsk& map, bool brief) {
  Json matches = Json::array();
  for (const auto& each : found.places) {
    Json match = {{"match", toString(each.match.grade)}, {"name", each.match.name}, {"cost", each.match.cost}};
    match.update(jsonOf(*each.place, brief));
    if (map.rooms) match["room"] = briefJson(roomOf(*map.rooms, *each.place));
    matches.push_back(std::move(match));
  }
  return matches;
}

std::string namesText(const std::vector<map::Place>& places) {
  std::vector<std::string> names;
  for (const auto& place : places) names.push_back(place.label);
  return listed(names);
}

}  // namespace omnimapper::query
