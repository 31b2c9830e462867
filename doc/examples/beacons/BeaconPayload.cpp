#include "BeaconPayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>

namespace beacons {

namespace graph = omnimapper::graph;

// The version comes first, so that a later version of the library can still read today's files.
constexpr std::uint64_t kVersion = 1;

void BeaconPayload::write(std::ostream& out) const {
  graph::writeUint(out, kVersion, 1);
  graph::writeUint(out, static_cast<std::uint32_t>(number), 4);
  graph::writeDouble(out, nearest);
  graph::writeDouble(out, farthest);
}

void BeaconPayload::addTo(omnimapper::map::PayloadRegistry& registry) {
  registry.add("beacon", [](std::istream& in) {
    const auto version = graph::readUint(in, 1);
    if (version != kVersion) {
      throw omnimapper::base::Error(omnimapper::base::ExitCode::unreadable_input,
                                    "a beacon of version " + std::to_string(version) + ": this library reads version " +
                                        std::to_string(kVersion) + "; take the library that wrote the map");
    }
    const auto number = static_cast<std::int32_t>(graph::readUint(in, 4));
    const double nearest = graph::readDouble(in);
    return std::make_shared<BeaconPayload>(number, nearest, graph::readDouble(in));
  });
}

}  // namespace beacons
