#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/query/Find.h>
#include <omnimapper/query/MapToAsk.h>
#include <omnimapper/query/editLabels.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "LabelledMapFile.h"
#include "MapLock.h"

namespace omnimapper::query {

namespace {

using map::Label;
using map::Labels;

[[noreturn]] void refuseLabel(const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, reason);
}

std::string quotedName(const std::string& text) {
  return "'" + base::printable(text.substr(0, 200)) + "'";
}

/// A label for a point of the map, in the frame of the key frame nearest to it.
Label labelAt(const LabelledMapFile& map, const Eigen::Vector3d& point) {
  const auto distance = [&](const map::FramePose& frame) {
    return (geometry::fromMrpt(frame.map_from_base).translation - point).norm();
  };
  const auto nearest = std::min_element(map.frames.begin(), map.frames.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  Label label;
  label.frame = nearest->id;
  label.in_frame = geometry::inverse(geometry::fromMrpt(nearest->map_from_base)) * point;
  return label;
}

Label labelOn(const LabelledMapFile& map, const std::string& id) {
  for (const map::Place& place : map.places.places) {
    if (!hasId(place, id)) continue;
    if (place.kind == Labels::kRegion || place.kind == Labels::kPlace)
      refuseLabel(quotedName(place.label) + " is a name already: rename it, or name the things themselves");
    Label label = labelAt(map, place.position);
    label.landmark = place.id;
    return label;
  }
  refuseLabel("nothing in the map has the number " + quotedName(id));
}

double metresOfLabel(const std::string& word) {
  constexpr double kFarthest = 1e6;  // [m]
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(std::abs(number) <= kFarthest))
    refuseLabel(quotedName(word) + " is not a coordinate in metres of at most a million");
  return number;
}

/// The height of the floor where the robot drove nearest to a point.
double floorAt(const LabelledMapFile& map, double x, double y) {
  const Label nearest = labelAt(map, {x, y, 0});
  const auto frame = std::find_if(map.frames.begin(), map.frames.end(),
                                  [&](const map::FramePose& each) { return each.id == nearest.frame; });
  return frame->map_from_base.z();
}

std::string addLabel(const LabelledMapFile& map, const LabelEdit& edit, map::LabelEdits& edits) {
  const auto& words = edit.words;
  const std::string& text = words.back();
  if (const auto why = map::whyNoLabel(text)) refuseLabel("the name " + *why);
  const bool is_point = words.size() == 4;
  const double x = is_point ? metresOfLabel(words[1]) : 0, y = is_point ? metresOfLabel(words[2]) : 0;
  Label label = is_point ? labelAt(map, {x, y, floorAt(map, x, y)}) : labelOn(map, words[1]);
  label.text = text;
  label.who = base::printable(edit.who);
  label.when = edit.when;
  if (!is_point && edits.has(label)) refuseLabel("it is called " + quotedName(text) + " already");
  edits.add(std::move(label));
  return "it is called " + quotedName(text) + " now";
}

std::string done(const map::LabelEdits::Outcome& outcome) {
  if (!outcome.is_done) refuseLabel(outcome.text);
  return outcome.text;
}

std::string apply(const LabelledMapFile& map, const LabelEdit& edit, map::LabelEdits& edits) {
  const auto& words = edit.words;
  const std::string verb = words.empty() ? "" : words.front();
  if (verb == "name" && (words.size() == 3 || words.size() == 4)) return addLabel(map, edit, edits);
  if (verb == "rename" && words.size() == 3) return done(edits.rename(words[1], words[2]));
  if (verb == "delete" && words.size() == 2) return done(edits.remove(words[1]));
  if (verb == "undo" && words.size() == 1) return done(edits.undo());
  refuseLabel("a change of labels is one of: name ID TEXT, name X Y TEXT, rename OLD NEW, delete TEXT, undo");
}

}  // namespace

std::string editLabels(const std::string& path, const LabelEdit& edit, map::LabelEdits& history) {
  const std::string file = openMap(path).file;
  if (isCheckpoint(file))
    throw base::Error(base::ExitCode::unreadable_input, "the run that makes this map has not ended");
  const MapLock lock(std::filesystem::path(file).parent_path().string());
  LabelledMapFile map = LabelledMapFile::read(file);
  map::LabelEdits edits = history;
  if (edits.now().toBytes() != map.labels.toBytes()) edits = {};
  edits.begin(map.labels);
  const std::string text = apply(map, edit, edits);
  map.labels = edits.now();
  map.write(file);
  history = std::move(edits);
  return text;
}

}  // namespace omnimapper::query
