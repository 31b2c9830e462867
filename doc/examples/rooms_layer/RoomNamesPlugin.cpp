#include "RoomNamesPlugin.h"

#include <mrpt/obs/CObservationRFID.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include <cmath>
#include <utility>

#include "Rooms.h"

namespace base = omnimapper::base;
namespace mapper = omnimapper::mapper;

namespace rooms_layer {

const base::OptionTable<RoomNamesOptions>& RoomNamesOptions::table() {
  static const auto table = base::OptionTable<RoomNamesOptions>().text(
      "label", &RoomNamesOptions::label, "Sensor label of the reader of tags; empty for every reader.");
  return table;
}

bool RoomNamesPlugin::watches(const mrpt::obs::CObservation& observation) const {
  return dynamic_cast<const mrpt::obs::CObservationRFID*>(&observation) &&
         (options_.label.empty() || observation.sensorLabel == options_.label);
}

// A layer is immutable, so the answer is a new one. Before the first key frame there is no place to name, and a run
// that only localizes does not change its map.
mapper::WatchResult RoomNamesPlugin::watch(const mapper::Watched& watched, const mapper::View& view) {
  mapper::WatchResult result;
  if (!watched.pose || view.map_is_held) return result;
  const auto* known = view.map.layers.find<Rooms>();
  Rooms layer = known ? *known : Rooms();
  const auto& at = watched.pose->frame_from_base.begin_from_end;
  bool is_new = false;
  for (const auto& tag : dynamic_cast<const mrpt::obs::CObservationRFID&>(watched.observation).tag_readings) {
    const auto room = layer.rooms.find(tag.epc);
    if (!std::isfinite(tag.power) || (room != layer.rooms.end() && room->second.power >= tag.power)) continue;
    layer.rooms[tag.epc] = {tag.power, watched.observation.timestamp, watched.pose->frame, {at.x(), at.y(), at.z()}};
    is_new = true;
  }
  if (is_new) result.batch.setLayer(std::move(layer));
  return result;
}

// Without this, a map that is continued would keep the layer as bytes, and find<Rooms>() would not know it.
void RoomNamesPlugin::registerKinds(mapper::Kinds& kinds) {
  kinds.layers.add<Rooms>();
}

const base::AtLoad kRegisterRoomNames([] { mapper::FactoryOf<RoomNamesPlugin, RoomNamesOptions>::registerClass(); });

}  // namespace rooms_layer
