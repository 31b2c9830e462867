#include "RoomFilesOutput.h"

#include <omnimapper/building/RoomsOfCells.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/building/RoomsPlan.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/ScanGrid.h>

#include "GridOfRun.h"
#include "RoomsLayer.h"
#include "SceneGraph.h"

namespace omnimapper::plugins {

const base::OptionTable<RoomFilesOutputOptions>& RoomFilesOutputOptions::table() {
  static const base::OptionTable<RoomFilesOutputOptions> table;
  return table;
}

RoomFilesOutput::RoomFilesOutput(const RoomFilesOutputOptions&, const mapper::PluginContext& context)
    : title_(context.title), folder_(derived::outputPath(context, "")) {}

void RoomFilesOutput::finish(const mapper::View& view) {
  const auto* layer = view.map.layers.find<RoomsLayer>();
  if (!layer) return;
  const building::Storey& storey = layer->rooms.building.storeys.front();
  derived::writeBytes(folder_ + "rooms.json", layer->toBytes());
  if (!layer->rooms.edits.edits.empty())
    derived::writeBytes(folder_ + "edits.json", building::encodeEdits(layer->rooms.edits));
  derived::writeBytes(folder_ + "plan.svg", building::encodePlan(storey));
  derived::writeBytes(folder_ + "scene_graph.json", encodeSceneGraph(view, storey, title_));
  const auto shared = derived::scanGridOf(view, {});
  if (!*shared) return;
  const grid::GridMap grid = gridMapOf(**shared);
  const building::Segmentation rooms{storey, building::roomsOfCells(storey, grid)};
  derived::writeBytes(folder_ + "rooms.png", draw::encodePng(building::drawRooms(grid, rooms)));
}

}  // namespace omnimapper::plugins
