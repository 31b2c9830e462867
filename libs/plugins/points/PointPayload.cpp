#include "PointPayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>

namespace omnimapper::plugins {

constexpr std::uint64_t kPointPayloadVersion = 1;

std::string PointPayload::label() const {
  return number < 0 ? "point" : "marker " + std::to_string(number);
}

std::shared_ptr<const PointPayload> PointPayload::with(const std::string& sensor_label,
                                                       double height_of_measurement) const {
  auto more = std::make_shared<PointPayload>(*this);
  ++more->seen_by[sensor_label];
  more->height += (height_of_measurement - height) / more->measurements();
  return more;
}

std::shared_ptr<const PointPayload> PointPayload::with(const PointPayload& other) const {
  auto both = std::make_shared<PointPayload>(*this);
  for (const auto& [label, measurements] : other.seen_by) both->seen_by[label] += measurements;
  both->height += (other.height - height) * other.measurements() / both->measurements();
  return both;
}

bool PointPayload::fits(const std::vector<std::string_view>& kinds) const {
  return kinds.size() == 1 && (kinds[0] == graph::point2()->kind() || kinds[0] == graph::point3()->kind());
}

std::uint32_t PointPayload::measurements() const {
  std::uint32_t sum = 0;
  for (const auto& [label, measurements] : seen_by) sum += measurements;
  return sum;
}

map::LandmarkShape PointPayload::shape(const std::vector<Eigen::VectorXd>& values, const map::KeyFrames&) const {
  map::LandmarkShape shape;
  if (values.empty()) return shape;
  const Eigen::VectorXd& value = values.front();
  shape.label = label();
  shape.points.emplace_back(value[0], value[1], value.size() > 2 ? value[2] : height);
  if (number >= 0) shape.properties.push_back({"number", std::to_string(number)});
  for (const auto& [label, measurements] : seen_by) shape.addSeenBy(label, measurements);
  return shape;
}

void PointPayload::write(std::ostream& out) const {
  graph::writeUint(out, kPointPayloadVersion, 1);
  graph::writeUint(out, static_cast<std::uint32_t>(number), 4);
  graph::writeDouble(out, height);
  graph::writeUint(out, seen_by.size(), 4);
  for (const auto& [label, measurements] : seen_by) {
    graph::writeText(out, label);
    graph::writeUint(out, measurements, 4);
  }
}

void PointPayload::addTo(map::PayloadRegistry& registry) {
  registry.add("point", [](std::istream& in) {
    if (const auto version = graph::readUint(in, 1); version > kPointPayloadVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "a point of version " + std::to_string(version) + ": this program reads versions up to " +
                            std::to_string(kPointPayloadVersion) + "; take the OmniMapper that wrote the map");
    }
    auto payload = std::make_shared<PointPayload>();
    payload->number = static_cast<std::int32_t>(graph::readUint(in, 4));
    payload->height = graph::readDouble(in);
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string label = graph::readText(in);
      payload->seen_by[label] = static_cast<std::uint32_t>(graph::readUint(in, 4));
    }
    return payload;
  });
}

}  // namespace omnimapper::plugins
