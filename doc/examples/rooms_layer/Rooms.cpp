#include "Rooms.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/plugin/SavedVariable.h>

#include <cmath>
#include <sstream>

namespace base = omnimapper::base;
namespace graph = omnimapper::graph;
namespace map = omnimapper::map;

namespace rooms_layer {

Eigen::Vector3d Room::inMap(const map::Map& map) const {
  const auto at = map.keyFrame(frame).map_from_base.composePoint({in_frame.x(), in_frame.y(), in_frame.z()});
  return {at.x, at.y, at.z};
}

std::string Rooms::toBytes() const {
  std::ostringstream out;
  graph::writeUint(out, rooms.size(), 4);
  for (const auto& [name, room] : rooms) {
    graph::writeText(out, name);
    graph::writeDouble(out, room.power);
    graph::writeText(out, base::formatUnix(room.read_at));
    graph::writeId(out, room.frame);
    graph::writeVector<3>(out, room.in_frame);
  }
  return out.str();
}

Rooms Rooms::fromSection(const map::MapSection& section) {
  omnimapper::mapper::expectVersion(section, kLayerVersion);
  std::istringstream in(section.bytes);
  Rooms read;
  for (auto left = graph::readUint(in, 4); left > 0; --left) {
    const std::string name = graph::readText(in);
    Room& room = read.rooms[name];
    room.power = graph::readDouble(in);
    room.read_at = base::parseUnix(graph::readText(in));
    room.frame = graph::readId<base::KeyFrameId>(in);
    room.in_frame = graph::readVector<3>(in);
    if (!room.in_frame.allFinite() || !std::isfinite(room.power)) {
      throw base::Error(base::ExitCode::unreadable_input, "map file, section \"" + section.name + "\": the room '" +
                                                              name +
                                                              "' has a number that is not finite: the file is damaged");
    }
  }
  return read;
}

map::LayerReferences Rooms::references() const {
  map::LayerReferences references;
  for (const auto& [name, room] : rooms) references.key_frames.push_back(room.frame);
  return references;
}

}  // namespace rooms_layer
