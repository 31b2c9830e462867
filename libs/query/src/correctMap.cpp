#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/map/ClosedLoops.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/LabelledPlaces.h>
#include <omnimapper/map/Layers.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/query/correctMap.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "LabelledMapFile.h"
#include "MapLock.h"

namespace omnimapper::query {

namespace {

using map::Corrections;

[[noreturn]] void refuseCorrection(const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, reason);
}

std::string idInMessage(const std::string& id) {
  return "'" + base::printable(id.substr(0, 200)) + "'";
}

/// A map that is corrected.
struct CorrectedMap {
  LabelledMapFile map;
  Corrections corrections;

  explicit CorrectedMap(const std::string& path) : map(LabelledMapFile::read(path)) {
    if (const auto* section = map.file.find(Corrections::kLayer)) corrections = Corrections::fromSection(*section);
  }
  void write(const std::string& path) {
    if (corrections.empty())
      map.file.remove(Corrections::kLayer);
    else
      map.file.set(map::layerToSection(Corrections::kLayer, map::LayerOf<Corrections>(corrections)));
    map.write(path);
  }
};

std::string removeThing(CorrectedMap& corrected, const Correction& correction) {
  auto& places = corrected.map.places.places;
  map::removeLabels(places);
  const std::string& id = correction.words[1];
  const auto place = std::find_if(places.begin(), places.end(), [&](const auto& each) { return hasId(each, id); });
  if (place == places.end()) refuseCorrection("no landmark in the map has the number " + idInMessage(id));
  const std::string what = place->label + " " + toString(place->id);
  corrected.corrections.deleted.push_back({std::move(*place), base::printable(correction.who), correction.when});
  places.erase(place);
  return what + " is deleted";
}

std::string restoreThing(CorrectedMap& corrected, const Correction& correction) {
  auto& deleted = corrected.corrections.deleted;
  const std::string& id = correction.words[1];
  const auto thing =
      std::find_if(deleted.begin(), deleted.end(), [&](const auto& each) { return hasId(each.place, id); });
  if (thing == deleted.end()) refuseCorrection("no landmark with the number " + idInMessage(id) + " was deleted");
  const std::string what = thing->place.label + " " + toString(thing->place.id);
  auto& places = corrected.map.places.places;
  const auto after =
      std::find_if(places.begin(), places.end(), [&](const auto& each) { return thing->place.id < each.id; });
  places.insert(after, std::move(thing->place));
  deleted.erase(thing);
  return what + " is in the map again";
}

std::string forbidLoop(CorrectedMap& corrected, const Correction& correction) {
  const auto &from = correction.words[1], &to = correction.words[2];
  const auto isIt = [&](const auto& each) { return toString(each.from) == from && toString(each.to) == to; };
  auto& forbidden = corrected.corrections.forbidden;
  if (std::any_of(forbidden.begin(), forbidden.end(), isIt)) refuseCorrection("that loop closure is forbidden already");
  const auto* section = corrected.map.file.find(map::ClosedLoops::kLayer);
  const auto loops = section ? map::ClosedLoops::fromSection(*section).loops : std::vector<map::ClosedLoop>();
  const auto loop = std::find_if(loops.begin(), loops.end(), isIt);
  if (loop == loops.end())
    refuseCorrection("the map has no loop closure between the key frames " + idInMessage(from) + " and " +
                     idInMessage(to));
  forbidden.push_back({loop->from, loop->to, base::printable(correction.who), correction.when});
  return "the loop closure is forbidden: the next session that continues the map removes it";
}

std::string allowLoop(CorrectedMap& corrected, const Correction& correction) {
  const auto &from = correction.words[1], &to = correction.words[2];
  auto& forbidden = corrected.corrections.forbidden;
  const auto loop = std::find_if(forbidden.begin(), forbidden.end(), [&](const auto& each) {
    return toString(each.from) == from && toString(each.to) == to;
  });
  if (loop == forbidden.end()) refuseCorrection("that loop closure is not forbidden");
  forbidden.erase(loop);
  return "the loop closure is allowed again";
}

std::string applyCorrection(CorrectedMap& corrected, const Correction& correction) {
  const auto& words = correction.words;
  const std::string verb = words.empty() ? "" : words.front();
  if (verb == "delete" && words.size() == 2) return removeThing(corrected, correction);
  if (verb == "restore" && words.size() == 2) return restoreThing(corrected, correction);
  if (verb == "forbid" && words.size() == 3) return forbidLoop(corrected, correction);
  if (verb == "allow" && words.size() == 3) return allowLoop(corrected, correction);
  refuseCorrection(
      "a correction is one of: delete ID, restore ID, which is that of a landmark such as 0:12; forbid FROM TO, allow "
      "FROM TO, which are the key frames of a loop closure");
}

}  // namespace

std::string correctMap(const std::string& path, const Correction& correction) {
  const std::string file = openMap(path).file;
  if (isCheckpoint(file))
    throw base::Error(base::ExitCode::unreadable_input, "the run that makes this map has not ended");
  const MapLock lock(std::filesystem::path(file).parent_path().string());
  CorrectedMap corrected(file);
  const std::string text = applyCorrection(corrected, correction);
  corrected.write(file);
  return text;
}

}  // namespace omnimapper::query
