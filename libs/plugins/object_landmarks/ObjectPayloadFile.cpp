// The format in which a map file holds objects.
#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>

#include <cmath>
#include <cstring>

#include "ObjectPayload.h"

namespace omnimapper::plugins {

namespace {

constexpr std::uint64_t kObjectPayloadVersion = 1;
constexpr double kFarthest = 1e4;  // [m] no camera sees farther

[[noreturn]] void refuse(const std::string& what) {
  throw base::Error(base::ExitCode::unreadable_input, "an object of the map " + what + ": damaged");
}

void writeFloat(std::ostream& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  graph::writeUint(out, bits, 4);
}

float readFloat(std::istream& in) {
  const auto bits = static_cast<std::uint32_t>(graph::readUint(in, 4));
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

Eigen::Vector3d readPlace(std::istream& in) {
  const Eigen::Vector3d place = graph::readVector<3>(in);
  if (!place.allFinite() || place.cwiseAbs().maxCoeff() > kFarthest)
    refuse("has a point that is not finite or kilometres away");
  return place;
}

void writeView(std::ostream& out, const ObjectView& view) {
  graph::writeId(out, view.frame);
  graph::writeDouble(out, view.distance);
  graph::writeVector(out, view.up);
  graph::writeUint(out, view.foot.has_value(), 1);
  if (view.foot) graph::writeVector(out, *view.foot);
  graph::writeUint(out, view.points.size(), 4);
  graph::writeUint(out, !view.colours.empty(), 1);
  for (const auto& point : view.points)
    for (const float coordinate : point) writeFloat(out, coordinate);
  for (const auto& colour : view.colours)
    graph::writeUint(out, colour.red | std::uint64_t{colour.green} << 8 | std::uint64_t{colour.blue} << 16, 3);
}

ObjectView readView(std::istream& in) {
  ObjectView view;
  view.frame = graph::readId<base::KeyFrameId>(in);
  view.distance = graph::readDouble(in);
  view.up = graph::readVector<3>(in);
  if (!(view.distance >= 0 && view.distance < kFarthest)) refuse("has a view without a valid distance");
  if (!(std::abs(view.up.norm() - 1) < 1e-6)) refuse("has a view whose direction up is not a unit vector");
  if (graph::readUint(in, 1) != 0) view.foot = readPlace(in);
  const auto count = graph::readUint(in, 4);
  const bool coloured = graph::readUint(in, 1) != 0;
  for (std::uint64_t i = 0; i < count; ++i) {  // a wrong count ends with the bytes, before it takes memory
    Eigen::Vector3f point;
    for (float& coordinate : point) coordinate = readFloat(in);
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthest)
      refuse("has a point that is not finite or kilometres away");
    view.points.push_back(point);
  }
  for (std::uint64_t i = 0; coloured && i < count; ++i) {
    const auto rgb = graph::readUint(in, 3);
    view.colours.push_back(
        {static_cast<std::uint8_t>(rgb), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb >> 16)});
  }
  return view;
}

void writePicture(std::ostream& out, const ObjectPicture& picture) {
  graph::writeUint(out, static_cast<std::uint64_t>(picture.pixels), 4);
  graph::writeUint(out, static_cast<std::uint64_t>(picture.photograph->width), 2);
  graph::writeUint(out, static_cast<std::uint64_t>(picture.photograph->height), 2);
  graph::writeText(out, {picture.photograph->rgb.begin(), picture.photograph->rgb.end()});
}

ObjectPicture readPicture(std::istream& in) {
  ObjectPicture picture;
  picture.pixels = static_cast<int>(graph::readUint(in, 4));
  map::Photograph photograph;
  photograph.width = static_cast<int>(graph::readUint(in, 2));
  photograph.height = static_cast<int>(graph::readUint(in, 2));
  const std::string bytes = graph::readText(in);
  if (bytes.empty() || bytes.size() != std::size_t{3} * photograph.width * photograph.height)
    refuse("has a picture whose number of pixels does not match its size");
  photograph.rgb.assign(bytes.begin(), bytes.end());
  picture.photograph = std::make_shared<const map::Photograph>(std::move(photograph));
  return picture;
}

}  // namespace

void ObjectPayload::write(std::ostream& out) const {
  graph::writeUint(out, kObjectPayloadVersion, 1);
  evidence.write(out);
  graph::writeUint(out, measured_in, 4);
  graph::writeUint(out, is_confirmed, 1);
  graph::writeUint(out, classes.size(), 4);
  for (const auto& [name, score] : classes) {
    graph::writeText(out, name);
    graph::writeDouble(out, score);
  }
  graph::writeUint(out, seen_by.size(), 4);
  for (const auto& [sensor, measurements] : seen_by) {
    graph::writeText(out, sensor);
    graph::writeUint(out, measurements, 4);
  }
  graph::writeUint(out, picture.has_value(), 1);
  if (picture) writePicture(out, *picture);
  for (const auto& other : {on, part_of}) {
    graph::writeUint(out, other.has_value(), 1);
    if (other) graph::writeId(out, *other);
  }
  graph::writeUint(out, model->views().size(), 4);
  for (const auto& view : model->views()) writeView(out, view);
}

void ObjectPayload::addTo(map::PayloadRegistry& registry) {
  registry.add("object", [](std::istream& in) {
    if (const auto version = graph::readUint(in, 1); version > kObjectPayloadVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "an object of version " + std::to_string(version) + ": this program reads versions up to " +
                            std::to_string(kObjectPayloadVersion) + "; take the OmniMapper that wrote the map");
    }
    auto payload = std::make_shared<ObjectPayload>();
    payload->evidence = ObjectEvidence::read(in);
    payload->measured_in = static_cast<std::uint32_t>(graph::readUint(in, 4));
    payload->is_confirmed = graph::readUint(in, 1) != 0;
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string name = graph::readText(in);
      const double score = graph::readDouble(in);
      if (!std::isfinite(score)) refuse("has a class whose score is not finite");
      payload->classes[name] = score;
    }
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string sensor = graph::readText(in);
      payload->seen_by[sensor] = static_cast<std::uint32_t>(graph::readUint(in, 4));
    }
    if (graph::readUint(in, 1) != 0) payload->picture = readPicture(in);
    for (auto* other : {&payload->on, &payload->part_of})
      if (graph::readUint(in, 1) != 0) *other = graph::readId<base::LandmarkId>(in);
    std::vector<ObjectView> views;
    for (auto left = graph::readUint(in, 4); left > 0; --left) views.push_back(readView(in));
    payload->model = std::make_shared<const ObjectModel>(std::move(views));
    return payload;
  });
}

}  // namespace omnimapper::plugins
