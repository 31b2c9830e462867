#include "ObjectPayload.h"

#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <set>

namespace omnimapper::plugins {

std::string ObjectPayload::label() const {
  const auto most = std::max_element(classes.begin(), classes.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == classes.end() ? "object" : most->first;
}

std::shared_ptr<ObjectPayload> ObjectPayload::with(const ObjectPayload& other, const map::KeyFrames& key_frames,
                                                   const ModelLimits& limits) const {
  auto both = std::make_shared<ObjectPayload>(*this);
  ObjectModel fused = *model;
  for (const auto& view : other.model->views()) fused = fused.with(view, key_frames, limits);
  both->model = std::make_shared<const ObjectModel>(std::move(fused));
  both->evidence.add(other.evidence);
  both->measured_in += other.measured_in;
  both->is_confirmed = is_confirmed || other.is_confirmed;
  for (const auto& [name, score] : other.classes) both->classes[name] += score;
  for (const auto& [sensor, measurements] : other.seen_by) both->seen_by[sensor] += measurements;
  if (other.picture && (!picture || other.picture->pixels > picture->pixels)) both->picture = other.picture;
  if (!on) both->on = other.on;
  return both;
}

std::shared_ptr<ObjectPayload> ObjectPayload::withoutModel() const {
  auto rest = std::make_shared<ObjectPayload>(*this);
  rest->model = std::make_shared<const ObjectModel>();
  rest->picture.reset();
  return rest;
}

bool ObjectPayload::fits(const std::vector<std::string_view>& kinds) const {
  return kinds.size() == 1 && kinds[0] == graph::point3()->kind();
}

std::vector<base::KeyFrameId> ObjectPayload::keyFrames() const {
  std::set<base::KeyFrameId> frames;
  for (const auto& view : model->views()) frames.insert(view.frame);
  return {frames.begin(), frames.end()};
}

std::shared_ptr<const map::LandmarkPayload> ObjectPayload::seenFrom(const std::set<base::KeyFrameId>& frames) const {
  ObjectModel part = model->seenFrom(frames);
  if (part.empty() || part.views().size() == model->views().size()) return nullptr;
  auto payload = std::make_shared<ObjectPayload>(*this);
  payload->model = std::make_shared<const ObjectModel>(std::move(part));
  return payload;
}

map::LandmarkShape ObjectPayload::shape(const std::vector<Eigen::VectorXd>& /*values*/,
                                        const map::KeyFrames& key_frames) const {
  map::LandmarkShape shape;
  shape.label = label();
  shape.is_candidate = !isDrawn();
  shape.box = model->box(key_frames);
  if (picture) shape.photograph = picture->photograph;
  const auto count = [&](const char* name, std::uint64_t value) { shape.properties.push_back({name, value}); };
  count("views", model->views().size());
  count("model_points", model->size());
  count("seen_in", evidence.seen_in);
  count("hidden_in", evidence.hidden_in);
  count("absent_in", evidence.absent_in);
  if (base::isValid(evidence.last_seen)) shape.properties.push_back({"last_seen_at", evidence.last_seen});
  if (base::isValid(evidence.last_looked)) shape.properties.push_back({"last_looked_at", evidence.last_looked});
  if (on) shape.properties.push_back({"on", toString(*on)});
  if (part_of) shape.properties.push_back({"part_of", toString(*part_of)});
  for (const auto& [sensor, measurements] : seen_by) shape.addSeenBy(sensor, measurements);
  return shape;
}

}  // namespace omnimapper::plugins
