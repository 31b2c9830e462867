#include "BoxPayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/map/KeyFrames.h>

#include <algorithm>

namespace boxes {

namespace base = omnimapper::base;
namespace graph = omnimapper::graph;
namespace map = omnimapper::map;

// The version comes first, so that a later version of the library can still read today's files.
constexpr std::uint64_t kVersion = 1;

std::string BoxPayload::classLabel() const {
  const auto most = std::max_element(classes.begin(), classes.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == classes.end() ? "" : most->first;
}

std::shared_ptr<const BoxPayload> BoxPayload::with(const Box& box, base::KeyFrameId seen_from) const {
  BoxPayload one;
  if (!box.class_label.empty()) one.classes[box.class_label] = box.score;
  one.size = box.size;
  one.frame = seen_from;
  one.base_from_box = box.base_from_box.rotation;
  one.measurements = 1;
  return with(one);
}

std::shared_ptr<const BoxPayload> BoxPayload::with(const BoxPayload& other) const {
  auto both = std::make_shared<BoxPayload>(*this);
  for (const auto& [label, score] : other.classes) both->classes[label] += score;
  both->measurements += other.measurements;
  both->size += (other.size - size) * other.measurements / both->measurements;
  both->frame = other.frame;
  both->base_from_box = other.base_from_box;
  return both;
}

map::LandmarkShape BoxPayload::shape(const std::vector<Eigen::VectorXd>& values,
                                     const map::KeyFrames& key_frames) const {
  map::LandmarkShape shape;
  const auto* seen_from = key_frames.find(frame);
  if (values.empty() || !seen_from) return shape;
  shape.label = classLabel();
  const auto map_from_base = omnimapper::geometry::fromMrpt(seen_from->map_from_base);
  shape.box = map::Box{values.front(), map_from_base.rotation * base_from_box, size};
  return shape;
}

void BoxPayload::write(std::ostream& out) const {
  graph::writeUint(out, kVersion, 1);
  graph::writeUint(out, classes.size(), 4);
  for (const auto& [label, score] : classes) {
    graph::writeText(out, label);
    graph::writeDouble(out, score);
  }
  graph::writeVector(out, size);
  graph::writeId(out, frame);
  graph::writeVector(out, base_from_box.coeffs());
  graph::writeUint(out, measurements, 4);
}

void BoxPayload::addTo(map::PayloadRegistry& registry) {
  registry.add("box", [](std::istream& in) {
    const auto version = graph::readUint(in, 1);
    if (version != kVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "a box of version " + std::to_string(version) + ": this library reads version " +
                            std::to_string(kVersion) + "; take the library that wrote the map");
    }
    auto payload = std::make_shared<BoxPayload>();
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string label = graph::readText(in);
      payload->classes[label] = graph::readDouble(in);
    }
    payload->size = graph::readVector<3>(in);
    payload->frame = graph::readId<base::KeyFrameId>(in);
    payload->base_from_box = Eigen::Quaterniond(graph::readVector<4>(in));
    payload->measurements = static_cast<std::uint32_t>(graph::readUint(in, 4));
    return payload;
  });
}

}  // namespace boxes
