// The scene graph of the box world with landmarks of all kinds.
#include <gtest/gtest.h>
#include <omnimapper/testing/ShapedRun.h>

#include <nlohmann/json.hpp>
#include <set>

#include "rooms/SceneGraph.h"

namespace scene_graph_test {
namespace {

using namespace shaped_run;
using nlohmann::json;

building::Storey boxStorey() {
  building::Storey storey;
  building::Room room;
  room.id = 3;
  room.outline = {{-1, -1}, {3, -1}, {3, 2}, {-1, 2}};
  room.centre = {1, 0.5};
  room.neighbours = {4};
  building::Room other = room;
  other.id = 4;
  for (auto& corner : other.outline) corner.x() += 4.1;
  other.neighbours = {3};
  building::Door door;
  door.id = 2;
  door.rooms = {3, 4};
  door.opening = {{3.05, 0}, {3.05, 1}};
  storey.rooms = {room, other};
  storey.doors = {door};
  building::UnseenRoom unseen;
  unseen.name = "118";
  unseen.seen_from = 3;
  storey.unseen = {unseen};
  return storey;
}

bool has(const json& graph, const std::string& kind, const std::string& from, const std::string& to) {
  for (const auto& relation : graph["relations"])
    if (relation["kind"] == kind && relation["from"] == from && relation["to"] == to) return true;
  return false;
}

TEST(SceneGraph, hasTheHierarchyAndDoorsAndEachIdOnce) {
  const RunRecord run = shapedRun();
  const json graph = json::parse(plugins::encodeSceneGraph(run.view(), boxStorey(), "box"));
  EXPECT_EQ(graph["schema"], "omnimapper-scene-graph");
  EXPECT_EQ(graph["version"], 1);
  std::set<std::string> ids;
  for (const auto& node : graph["nodes"]) EXPECT_TRUE(ids.insert(node["id"]).second) << node["id"];
  for (const auto& relation : graph["relations"])
    for (const char* end : {"from", "to"}) EXPECT_EQ(ids.count(relation[end]), 1U) << relation;
  EXPECT_TRUE(has(graph, "contains", "building", "storey 1"));
  EXPECT_TRUE(has(graph, "contains", "storey 1", "room 3"));
  EXPECT_TRUE(has(graph, "contains", "room 3", "0:2")) << "the table";
  EXPECT_TRUE(has(graph, "through", "door 2", "room 4"));
  EXPECT_TRUE(has(graph, "next to", "room 3", "room 4"));
  EXPECT_TRUE(has(graph, "next to", "room 3", "unseen 1"));
  EXPECT_TRUE(has(graph, "contains", "room 3", "place 0:0"));
}

TEST(SceneGraph, aThingIsOnTheTableThatIsJustBelowIt) {
  RunRecord run = shapedRun();
  map::LandmarkShape cup;
  cup.label = "cup";
  cup.box = map::Box{{0.25, -0.2, 0.76}, Eigen::Quaterniond::Identity(), {0.1, 0.1, 0.1}};
  const std::string standing = toString(add(run, "thing", cup));
  cup.box->middle.z() = 1.1;
  const std::string hanging = toString(add(run, "thing", cup));
  const json graph = json::parse(plugins::encodeSceneGraph(run.view(), boxStorey(), "box"));
  EXPECT_TRUE(has(graph, "on", standing, "0:2"));
  EXPECT_FALSE(has(graph, "on", hanging, "0:2")) << "it hangs in the air";
}

}  // namespace
}  // namespace scene_graph_test
