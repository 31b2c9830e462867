// The rooms of the box world, a room of 4 m x 3 m: the layer, its files, and what a continued map keeps.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>

#include "rooms/RoomsLayer.h"
#include "rooms/RoomsOutput.h"
#include "rooms/RoomsPlugin.h"

namespace rooms_plugin_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;
using plugins::RoomsLayer;

mapper::Batch atEnd(const RunRecord& run, bool map_is_held = false) {
  mapper::View view = run.view();
  view.map_is_held = map_is_held;
  plugins::RoomsPlugin plugin({}, {});
  return plugin.atEnd(view);
}

/// The layer that the plugin sets; fails the test if it sets none.
RoomsLayer layerOf(const RunRecord& run) {
  const mapper::Batch batch = atEnd(run);
  if (batch.layers().size() != 1) {
    ADD_FAILURE() << "the plugin sets no layer";
    return {};
  }
  return dynamic_cast<const map::LayerOf<RoomsLayer>&>(*batch.layers().front().second).value;
}

const building::Storey& storeyOf(const RoomsLayer& layer) {
  return layer.rooms.building.storeys.front();
}

mapper::PluginContext contextFor(const std::string& folder) {
  mapper::PluginContext context;
  context.section = "rooms_files";
  context.output_folder = folder;
  return context;
}

TEST(RoomsPlugin, theBoxIsOneRoomThatIsAnchoredToAKeyFrame) {
  const RoomsLayer layer = layerOf(boxRun());
  ASSERT_EQ(storeyOf(layer).rooms.size(), 1U);
  const building::Room& room = storeyOf(layer).rooms.front();
  EXPECT_NEAR(room.area, 11.84, 1) << "without the pillar";
  EXPECT_TRUE(building::contains(room, {1, 0}));
  ASSERT_TRUE(room.anchor);
  EXPECT_EQ(layer.references().key_frames, std::vector<base::KeyFrameId>({room.anchor->frame}));
  EXPECT_FALSE(atEnd(boxRun()).changesGraph());
}

TEST(RoomsPlugin, aRunThatLocalizesAndAMapWithoutScansSetNoLayer) {
  EXPECT_TRUE(atEnd(boxRun(), true).empty());
  RunRecord run = boxRun();
  for (const auto& frame : boxRun().map.key_frames) run.map.key_frames.edit(frame.id).observations.clear();
  const mapper::Batch batch = atEnd(run);
  EXPECT_TRUE(batch.layers().empty());
  ASSERT_EQ(batch.decisions().size(), 1U);
  EXPECT_NE(batch.decisions()[0].reason.find("no level 2D scan"), std::string::npos);
}

TEST(RoomsPlugin, aContinuedMapKeepsTheIdAndTheNameOfAUser) {
  RunRecord run = boxRun();
  RoomsLayer earlier = layerOf(run);
  auto& storey = earlier.rooms.building.storeys.front();
  storey.rooms.front().id = 5;
  storey.rooms.front().name = "den";
  storey.rooms.front().why = {{building::NameEvidence::Source::user, "renamed", 1}};
  storey.next_room = 9;
  run.map.layers.set(earlier);
  const RoomsLayer now = layerOf(run);
  ASSERT_EQ(storeyOf(now).rooms.size(), 1U);
  EXPECT_EQ(storeyOf(now).rooms.front().id, 5);
  EXPECT_EQ(storeyOf(now).rooms.front().name, "den");
  EXPECT_EQ(storeyOf(now).next_room, 9);
  EXPECT_TRUE(now.rooms.gone.empty());
}

TEST(RoomsPlugin, aRoomKeepsItsIdIfALoopClosureMovesTheWholeMap) {
  RunRecord run = boxRun();
  RoomsLayer earlier = layerOf(run);
  earlier.rooms.building.storeys.front().rooms.front().id = 5;
  earlier.rooms.building.storeys.front().next_room = 9;
  run.map.layers.set(earlier);
  const CPose3D moved(20, -7, 0, 1.2, 0, 0);
  for (const auto& frame : boxRun().map.key_frames)
    run.map.key_frames.edit(frame.id).map_from_base = moved + frame.map_from_base;
  EXPECT_EQ(storeyOf(layerOf(run)).rooms.front().id, 5);
}

TEST(RoomsLayer, isReadBackAndRefusedIfItIsOfALaterVersionOrDamaged) {
  const RoomsLayer layer = layerOf(boxRun());
  EXPECT_EQ(RoomsLayer::fromSection({"rooms", 1, layer.toBytes()}).toBytes(), layer.toBytes());
  for (const map::MapSection& bad : {map::MapSection{"rooms", 2, layer.toBytes()}, {"rooms", 1, "kitchen"}})
    EXPECT_THROW(RoomsLayer::fromSection(bad), base::Error);
}

TEST(RoomsOutput, writesItsFilesAndNoneWithoutRooms) {
  RunRecord run = boxRun();
  ScratchFolder folder;
  plugins::RoomsOutput output({}, contextFor(folder.path()));
  output.finish(run.view());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const RoomsLayer layer = layerOf(run);
  run.map.layers.set(layer);
  output.finish(run.view());
  for (const char* name : {"rooms.json", "rooms.png", "plan.svg", "scene_graph.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  const auto read = building::readRooms(folder / "rooms.json");
  EXPECT_EQ(building::encodeRooms(read), layer.toBytes());
}

}  // namespace
}  // namespace rooms_plugin_test
