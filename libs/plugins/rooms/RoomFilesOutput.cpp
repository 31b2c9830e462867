#include "RoomFilesOutput.h"

#include <omnimapper/building/RoomsOfCells.h>
#include <omnimapper/building/RoomsPicture.h>
#include <omnimapper/building/RoomsPlan.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/derived/PlanShape.h>
#include <omnimapper/derived/ScanGrid.h>
#include <omnimapper/derived/ThingsOfMap.h>

#include <optional>

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

namespace {

// The base line of an upright surface; none if it has none.
std::optional<geometry::Segment2> baseLineOf(const map::LandmarkShape& shape) {
  std::optional<geometry::Segment2> longest;
  for (const auto& [from, to] : derived::fromAbove(shape).lines)
    if (!longest || (to - from).norm() > geometry::length(*longest)) longest = geometry::Segment2{from, to};
  return longest;
}

building::PlanContents contentsOf(const mapper::State& state) {
  building::PlanContents contents;
  const auto landmarks = derived::shapesOf(state);
  for (const auto& thing : derived::thingsOf(landmarks, state.map))
    contents.things.push_back({toString(thing.is), thing.corners()});
  for (const auto& [landmark, shape, moved] : landmarks) {
    const auto line = moved ? std::nullopt : baseLineOf(shape);
    if (line && shape.label == "door") contents.leaves.push_back(*line);
    if (line && shape.label == "window") contents.windows.push_back(*line);
  }
  return contents;
}

}  // namespace

void RoomFilesOutput::finish(const mapper::View& view) {
  const auto* layer = view.map.layers.find<RoomsLayer>();
  if (!layer) return;
  const building::Storey& storey = layer->rooms.building.storeys.front();
  derived::writeBytes(folder_ + "rooms.json", layer->toBytes());
  if (const auto& edits = layer->rooms.edits; !edits.edits.empty() || !edits.elsewhere.empty())
    derived::writeBytes(folder_ + "edits.json", building::encodeEdits(edits));
  derived::writeBytes(folder_ + "plan.svg", building::encodePlan(storey, contentsOf(view)));
  derived::writeBytes(folder_ + "scene_graph.json", encodeSceneGraph(view, storey, title_));
  const auto shared = derived::scanGridOf(view, {});
  if (!*shared) return;
  const grid::GridMap grid = gridMapOf(**shared);
  const building::Segmentation rooms{storey, building::roomsOfCells(storey, grid)};
  derived::writeBytes(folder_ + "rooms.png", draw::encodePng(building::drawRooms(grid, rooms)));
}

}  // namespace omnimapper::plugins
