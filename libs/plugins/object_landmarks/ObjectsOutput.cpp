#include "ObjectsOutput.h"

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/Ply.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/map/Corrections.h>

#include <nlohmann/json.hpp>

#include "ObjectPayload.h"

namespace omnimapper::plugins {

using nlohmann::json;

const base::OptionTable<ObjectsOptions>& ObjectsOptions::table() {
  static const base::OptionTable<ObjectsOptions> table;
  return table;
}

namespace {

std::string nameOf(base::LandmarkId id) {
  return std::to_string(id.session) + "-" + std::to_string(id.index);
}

json numbersOf(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

json secondsOf(base::Stamp stamp) {
  return base::isValid(stamp) ? json(base::unixSeconds(stamp)) : json(nullptr);
}

std::string modelOf(const ObjectPayload& payload, const map::KeyFrames& key_frames) {
  const auto points = payload.model->pointsInMap(key_frames);
  const auto colours = payload.model->colours();
  std::vector<derived::ColouredPoint> coloured;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [red, green, blue] = colours[i];
    coloured.push_back({{points[i].x(), points[i].y(), points[i].z()}, {red, green, blue}});
  }
  return derived::encodePly(coloured);
}

std::string pictureFile(const map::Photograph& photograph) {
  draw::Image image(photograph.width, photograph.height, {});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {photograph.rgb[3 * i], photograph.rgb[3 * i + 1], photograph.rgb[3 * i + 2]};
  return draw::encodePng(image);
}

// The landmark into which another was merged, or itself; none if it is no longer in the map.
std::optional<base::LandmarkId> whatBecameOf(std::optional<base::LandmarkId> id, const map::Map& map) {
  while (id) {
    const map::Landmark* landmark = map.landmarks.find(*id);
    if (landmark == nullptr || landmark->state == map::Landmark::State::retired) return std::nullopt;
    if (landmark->state == map::Landmark::State::active) return id;
    id = landmark->merged_into;
  }
  return id;
}

json aboutObject(const map::Landmark& landmark, const ObjectPayload& payload, const map::Box& box,
                 const map::Map& map) {
  const bool is_gone = landmark.state == map::Landmark::State::retired;
  const auto on = whatBecameOf(payload.on, map), part_of = whatBecameOf(payload.part_of, map);
  const auto& q = box.map_from_box;
  const auto& evidence = payload.evidence;
  const std::string file = "objects/" + nameOf(landmark.id);
  json absent_at = json::array();
  for (const auto stamp : evidence.absent_at) absent_at.push_back(secondsOf(stamp));
  return {{"id", nameOf(landmark.id)},
          {"state", !payload.isDrawn() ? "candidate"
                    : is_gone          ? "gone"
                                       : "present"},
          {"label", payload.label()},
          {"box",
           {{"middle", numbersOf(box.middle)},
            {"map_from_box", {q.w(), q.x(), q.y(), q.z()}},
            {"size", numbersOf(box.size)}}},
          {"points", payload.model->size()},
          {"views", payload.model->views().size()},
          {"measured_in", payload.measured_in},
          {"seen_in", evidence.seen_in},
          {"hidden_in", evidence.hidden_in},
          {"absent_in", evidence.absent_in},
          {"absent_at", absent_at},
          {"first_seen", secondsOf(evidence.first_seen)},
          {"last_seen", secondsOf(evidence.last_seen)},
          {"last_looked", secondsOf(evidence.last_looked)},
          {"on", on ? json(nameOf(*on)) : json(nullptr)},
          {"part_of", part_of ? json(nameOf(*part_of)) : json(nullptr)},
          {"model", file + ".ply"},
          {"picture", payload.picture ? json(file + ".png") : json(nullptr)}};
}

}  // namespace

ObjectsOutput::ObjectsOutput(const ObjectsOptions&, const mapper::PluginContext& context)
    : title_(context.title),
      path_(derived::outputPath(context, "objects.json")),
      folder_(derived::outputPath(context, "objects")) {}

void ObjectsOutput::finish(const mapper::View& view) {
  json objects = json::array();
  std::size_t merged = 0;
  const auto deleted = map::deletedLandmarks(view.map);
  for (const auto& [id, landmark] : view.map.landmarks) {
    const auto* payload = dynamic_cast<const ObjectPayload*>(landmark.payload.get());
    if (payload == nullptr || deleted.count(id) > 0) continue;
    merged += landmark.state == map::Landmark::State::merged;
    if (landmark.state == map::Landmark::State::merged) continue;
    // Candidates that were given up are of no use to anybody.
    if (landmark.state == map::Landmark::State::retired && !payload->is_confirmed) continue;
    const auto box = payload->model->box(view.map.key_frames);
    if (!box) continue;
    if (objects.empty()) base::makeWritableFolder(folder_);
    objects.push_back(aboutObject(landmark, *payload, *box, view.map));
    const std::string file = folder_ + "/" + nameOf(id);
    derived::writeBytes(file + ".ply", modelOf(*payload, view.map.key_frames));
    if (payload->picture) derived::writeBytes(file + ".png", pictureFile(*payload->picture->photograph));
  }
  const json all = {{"schema", "omnimapper-objects"},
                    {"version", 1},
                    {"map", title_},
                    {"merged", merged},
                    {"objects", std::move(objects)}};
  derived::writeBytes(path_, all.dump(1, ' ', true, json::error_handler_t::replace) + "\n");
}

}  // namespace omnimapper::plugins
