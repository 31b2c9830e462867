#include "RoomsPlugin.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/ScanGrid.h>

#include "GridOfRun.h"
#include "RoomsLayer.h"
#include "roomsOfMap.h"

namespace omnimapper::plugins {

const base::OptionTable<RoomsOptions>& RoomsOptions::table() {
  using Options = RoomsOptions;
  static const auto table = base::OptionTable<Options>()
                                .number("resolution_m", &Options::resolution, {0.02, 0.1},
                                        "Side of the cells of the grid in which rooms are found.")
                                .number("max_range_m", &Options::max_range, {0.1, 1000},
                                        "Length up to which beams are entered into the grid.")
                                .number("robot_radius_m", &Options::robot_radius, {0, 2},
                                        "No wall is closer than this to the way of the base.")
                                .text("edits", &Options::edits,
                                      "File edits.json of an earlier map of the place, in any frame, whose edits are "
                                      "applied; empty for none. A "
                                      "map that is continued keeps its own edits without it.");
  return table;
}

void RoomsPlugin::registerKinds(mapper::Kinds& kinds) {
  kinds.layers.add<RoomsLayer>();
}

RoomsPlugin::RoomsPlugin(const RoomsOptions& options, const mapper::PluginContext& context)
    : options_(options), section_(context.section) {
  if (!options_.edits.empty()) edits_ = building::readEdits(options_.edits);
}

mapper::Batch RoomsPlugin::atEnd(const mapper::View& view) {
  mapper::Batch batch;
  if (view.map_is_held) return batch;
  const auto log = [&](const std::string& reason, bool accepted = false) {
    mapper::Decision decision(view.map.key_frames.back(), section_, "rooms");
    decision.accepted = accepted;
    decision.reason = reason;
    batch.log(std::move(decision));
  };
  derived::ScanGridOptions of_grid;
  of_grid.resolution = options_.resolution;
  of_grid.max_range = options_.max_range;
  const auto shared = derived::scanGridOf(view, of_grid);
  constexpr double kCoarse = 0.12;  // [m] in larger cells doors are hardly visible
  if (!*shared) {
    log("the map has no level 2D scan, and so no grid in which rooms could be found");
  } else if ((*shared)->resolution > kCoarse) {
    log("the map is so large that cells are " + base::brief((*shared)->resolution) + " m wide, too wide for doors");
  } else {
    auto rooms = roomsOfMap(view, withDrivenWay(gridMapOf(**shared), view.map, options_.robot_radius), edits_);
    for (const auto& [edit, why_not] : rooms.edits)
      log(edit + (why_not.empty() ? "" : ": " + why_not), why_not.empty());
    batch.setLayer(std::move(rooms.layer));
  }
  return batch;
}

}  // namespace omnimapper::plugins
