// The rooms of the box world, a room of 4 m x 3 m: the layer, its files, and what a continued map keeps.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

#include "rooms/RoomFilesOutput.h"
#include "rooms/RoomsLayer.h"
#include "rooms/RoomsPlugin.h"

namespace rooms_plugin_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;
using plugins::RoomsLayer;

mapper::Batch atEnd(const RunRecord& run, bool map_is_held = false, const plugins::RoomsOptions& options = {}) {
  mapper::View view = run.view();
  view.map_is_held = map_is_held;
  plugins::RoomsPlugin plugin(options, {});
  return plugin.atEnd(view);
}

/// The layer that the plugin sets; fails the test if it sets none.
RoomsLayer layerOf(const mapper::Batch& batch) {
  if (batch.layers().size() != 1) {
    ADD_FAILURE() << "the plugin sets no layer";
    return {};
  }
  return dynamic_cast<const map::LayerOf<RoomsLayer>&>(*batch.layers().front().second).value;
}

RoomsLayer layerOf(const RunRecord& run) {
  return layerOf(atEnd(run));
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

building::RoomEdit renameTo(const std::string& name) {
  return {building::RoomEdit::Kind::rename, name, {{1, 0}}};
}

/// What the decisions say, one line each.
std::string saidBy(const mapper::Batch& batch) {
  std::string said;
  for (const auto& decision : batch.decisions()) said += decision.reason + "\n";
  return said;
}

/// The box with a layer that has some edits, and a file of edits.
class EditsOfRooms : public ::testing::Test {
 protected:
  EditsOfRooms() : layer_(layerOf(run_)) {}
  building::RoomEdits editsHere(const std::vector<building::RoomEdit>& edits) const {
    return building::anchoredTo({edits, {}, {}}, storeyOf(layer_), {});
  }
  void setLayer(const building::RoomEdits& edits) {
    layer_.rooms.edits = edits;
    run_.map.layers.set(layer_);
  }
  mapper::Batch continued(const building::RoomEdits& of_file) const {
    std::ofstream(folder_ / "edits.json") << building::encodeEdits(of_file);
    plugins::RoomsOptions options;
    options.edits = folder_ / "edits.json";
    return atEnd(run_, false, options);
  }
  static building::RoomEdits elsewhere() { return {{renameTo("cellar")}, {{{0, 0}, {90, 0}, {90, 1}, {0, 1}}}, {}}; }

  RunRecord run_ = boxRun();
  RoomsLayer layer_;
  ScratchFolder folder_;
};

TEST_F(EditsOfRooms, AFileThatCannotBeReadIsRefusedBeforeTheRun) {
  plugins::RoomsOptions options;
  options.edits = folder_ / "edits.json";
  EXPECT_THROW(plugins::RoomsPlugin(options, {}), base::Error);
  std::ofstream(options.edits) << "{}";
  EXPECT_THROW(plugins::RoomsPlugin(options, {}), base::Error);
}

TEST_F(EditsOfRooms, TheMapKeepsThoseThatCannotBeAppliedNow) {
  setLayer(editsHere({{building::RoomEdit::Kind::merge, "", {{1, 0}, {9, 9}}}, renameTo("den")}));
  const mapper::Batch batch = atEnd(run_);
  const auto edits = layerOf(batch).rooms.edits.edits;
  ASSERT_EQ(edits.size(), 2U);
  EXPECT_EQ(edits[0].kind, building::RoomEdit::Kind::merge);
  EXPECT_EQ(storeyOf(layerOf(batch)).rooms.front().name, "den");
  EXPECT_NE(saidBy(batch).find("there is no room at 9.00 9.00; kept for a later session"), std::string::npos);
  const auto of_file = layerOf(continued(editsHere({{building::RoomEdit::Kind::remove, "", {{9, 9}}}})));
  EXPECT_EQ(of_file.rooms.edits.edits.size(), 2U) << "one of a file that cannot be applied is none of the map";
}

TEST_F(EditsOfRooms, TheMapKeepsThoseOfAPlaceThatWasNotFoundAsTheyAre) {
  setLayer(elsewhere());
  const mapper::Batch batch = continued(editsHere({renameTo("den")}));
  const auto kept = layerOf(batch).rooms.edits;
  ASSERT_EQ(kept.elsewhere.size(), 1U);
  EXPECT_EQ(building::encodeEdits(kept.elsewhere[0]), building::encodeEdits(elsewhere()));
  ASSERT_EQ(kept.edits.size(), 1U) << "those of the file are of this place, and are kept beside them";
  EXPECT_EQ(kept.edits[0].name, "den");
  EXPECT_EQ(storeyOf(layerOf(batch)).rooms.front().name, "den");
  EXPECT_NE(saidBy(batch).find("of another place; kept for a later session"), std::string::npos) << saidBy(batch);
}

TEST_F(EditsOfRooms, ThoseThatWereKeptAreAppliedWhenTheirPlaceIsSeenAgain) {
  building::RoomEdits edits = elsewhere();
  edits.elsewhere = {editsHere({renameTo("den")})};
  setLayer(edits);
  const auto now = layerOf(atEnd(run_));
  EXPECT_EQ(storeyOf(now).rooms.front().name, "den");
  ASSERT_EQ(now.rooms.edits.edits.size(), 1U);
  EXPECT_EQ(now.rooms.edits.edits[0].name, "den");
  ASSERT_EQ(now.rooms.edits.elsewhere.size(), 1U);
  EXPECT_EQ(now.rooms.edits.elsewhere[0].edits[0].name, "cellar");
}

TEST_F(EditsOfRooms, TheRoomsOfASplitKeepTheirNumbersAndTheirDoorOverSessions) {
  const auto& outline = storeyOf(layer_).rooms.front().outline;
  double low = outline.front().y(), high = low;
  for (const auto& corner : outline) low = std::min(low, corner.y()), high = std::max(high, corner.y());
  const building::RoomEdit split{building::RoomEdit::Kind::split, "", {{0.3, low}, {0.3, high}}};
  const building::RoomEdit rename{building::RoomEdit::Kind::rename, "nook", {{-0.8, 0}}};
  setLayer(editsHere({split, rename}));
  const RoomsLayer first = layerOf(atEnd(run_));
  ASSERT_EQ(storeyOf(first).rooms.size(), 2U);
  run_.map.layers.set(first);
  const RoomsLayer second = layerOf(atEnd(run_));
  EXPECT_EQ(second.toBytes(), first.toBytes()) << "nothing else was seen";
}

TEST_F(EditsOfRooms, ThoseOfAFileThatTheMapHasAreNotAppliedAgain) {
  setLayer(editsHere({renameTo("den")}));
  const auto again = continued(editsHere({renameTo("den")}));
  EXPECT_EQ(layerOf(again).rooms.edits.edits.size(), 1U);
  EXPECT_EQ(again.decisions().size(), 1U);
  const auto more = layerOf(continued(editsHere({renameTo("den"), renameTo("hall"), renameTo("den")})));
  EXPECT_EQ(more.rooms.edits.edits.size(), 3U) << "the one edit of the map stands for the first of them";
  EXPECT_EQ(storeyOf(more).rooms.front().name, "den");
}

TEST(RoomsLayer, isReadBackAndRefusedIfItIsOfALaterVersionOrDamaged) {
  const RoomsLayer layer = layerOf(boxRun());
  EXPECT_EQ(RoomsLayer::fromSection({"rooms", 1, layer.toBytes()}).toBytes(), layer.toBytes());
  for (const map::MapSection& bad : {map::MapSection{"rooms", 2, layer.toBytes()}, {"rooms", 1, "kitchen"}})
    EXPECT_THROW(RoomsLayer::fromSection(bad), base::Error);
}

TEST(RoomFilesOutput, writesItsFilesAndNoneWithoutRooms) {
  RunRecord run = boxRun();
  ScratchFolder folder;
  plugins::RoomFilesOutput output({}, contextFor(folder.path()));
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
