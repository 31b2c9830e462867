#include <gtest/gtest.h>
#include <omnimapper/graph/PointFactor.h>
#include <omnimapper/graph/VariableKinds.h>
#include <omnimapper/plane_factors/PlaneFactors.h>
#include <omnimapper/plane_factors/PlaneVariable.h>
#include <omnimapper/plane_factors/WallFactor.h>
#include <omnimapper/plane_factors/WallVariable.h>

#include <algorithm>

#include "planes/PlanePayload.h"
#include "relations/Relations.h"

namespace omnimapper::plugins::relations_found_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Plane3;
using geometry::Segment2;

/// Landmarks that were measured once, from the origin of the map.
class Place {
 public:
  Place() {
    flat_pose_ = graph_.addVariable(graph::se2(), Vector3d::Zero(), true);
    pose_ = graph_.addVariable(graph::se3(), graph::toValue(geometry::Se3()), true);
    frame_.id = map_.key_frames.nextId(0);
    frame_.stamp = base::stampFromUnix(1e9);
    frame_.pose = pose_;
    map_.key_frames.insert(frame_);
  }

  base::VariableId addWall(const Segment2& wall, std::uint16_t session = 0) {
    graph_.setSession(session);
    const auto id = graph_.addVariable(plane_factors::wallVariable(), plane_factors::toValue(wall));
    graph_.addFactor({{flat_pose_, id},
                      std::make_shared<plane_factors::WallFactor>(direction(wall), middle(wall)),
                      graph::SquareRootInformation::fromSigmas(Vector2d(0.01, 0.01))});
    addLandmark(id, nullptr);
    return id;
  }
  base::VariableId addPlane(const Plane3& plane, const std::vector<Vector3d>& outline) {
    const auto id = graph_.addVariable(plane_factors::planeVariable(), plane_factors::toValue(plane));
    graph_.addFactor({{pose_, id},
                      std::make_shared<plane_factors::PlaneFactor>(plane),
                      graph::SquareRootInformation::fromSigmas(Vector3d(0.01, 0.01, 0.01))});
    auto payload = std::make_shared<PlanePayload>();
    payload->patches.push_back({frame_.id, outline});
    payload->seen_by["kinect"].planes = 5;
    addLandmark(id, payload);
    return id;
  }
  base::VariableId addPoint(const Vector3d& point) {
    const auto id = graph_.addVariable(graph::point3(), point);
    graph_.addFactor({{pose_, id},
                      std::make_shared<graph::PointFactor3>(point),
                      graph::SquareRootInformation::fromSigmas(Vector3d(0.02, 0.02, 0.02))});
    addLandmark(id, nullptr);
    return id;
  }
  map::Map& map() { return map_; }

  std::vector<Relation> relations(const KnownRelations& known = {}, const RelationsOptions& options = {}) const {
    const mapper::Uncertainty uncertainty(graph_);
    return findRelations({map_, graph_, uncertainty}, options, known);
  }
  std::vector<std::string> names(const KnownRelations& known = {}) const {
    std::vector<std::string> all;
    for (const auto& relation : relations(known)) all.push_back(relation.name);
    return all;
  }

 private:
  void addLandmark(base::VariableId variable, std::shared_ptr<const map::LandmarkPayload> payload) {
    map::Landmark landmark;
    landmark.id = map_.landmarks.nextId(variable.session);
    landmark.variables = {variable};
    landmark.payload = std::move(payload);
    landmark.evidence = 5;
    map_.landmarks.add(variable.session, std::move(landmark));
  }

  graph::Graph graph_;
  map::Map map_;
  map::KeyFrame frame_;
  base::VariableId flat_pose_, pose_;
};

using Names = std::vector<std::string>;

// Free sides inwards; the last one goes on beside the first, on the same line.
const std::vector<Segment2> kBox = {{{3, 0}, {0, 0}}, {{3, 4}, {3, 0}}, {{0, 4}, {3, 4}}, {{0, 0}, {0, 4}}};
const Segment2 kBeside = {{8, 0}, {5, 0}};

KnownRelations acting(const std::vector<Relation>& relations) {
  KnownRelations known;
  for (const auto& relation : relations) known[relation.pair] = true;
  return known;
}

// A direction that four walls share gives three relations, not six.
TEST(RelationsFound, OfWallsAreATree) {
  Place place;
  for (const Segment2& side : kBox) place.addWall(side);
  const auto found = place.relations();
  EXPECT_EQ(found.size(), 3U);
  EXPECT_TRUE(place.relations(acting(found)).empty());
  RelationsOptions shy;
  shy.min_measurements = 6;
  EXPECT_TRUE(place.relations({}, shy).empty());
}

TEST(RelationsFound, OneNewWallGetsOneRelation) {
  Place place;
  for (const Segment2& side : kBox) place.addWall(side);
  const auto known = acting(place.relations());
  const auto fresh = place.addWall({{2, 2}, {1, 2}});
  const auto found = place.relations(known);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].record.variables[0] == fresh || found[0].record.variables[1] == fresh);
}

TEST(RelationsFound, OneLineIsRelatedThoughDirectionsAre) {
  Place place;
  const auto a = place.addWall(kBox[0]), across = place.addWall(kBox[1]), b = place.addWall(kBeside);
  const RelatedPair a_across{"wall_turn", {a, across}}, across_b{"wall_turn", {across, b}};
  const auto found = place.relations({{a_across, true}, {across_b, true}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "on one line");
  EXPECT_EQ(found[0].record.factor->kind(), "wall_shift") << "directions are known already";
  EXPECT_EQ(found[0].record.variables, (std::vector<base::VariableId>{a, b}));
  EXPECT_TRUE(place.names({{a_across, true}, {across_b, true}, {found[0].pair, true}}).empty());
  EXPECT_TRUE(place.names({{a_across, true}, {across_b, true}, {found[0].pair, false}}).empty()) << "asked once";
}

TEST(RelationsFound, WhatIsOnOneLineIsInParallel) {
  Place place;
  const auto a = place.addWall(kBox[0]), b = place.addWall(kBeside);
  EXPECT_EQ(place.names(), Names{"on one line"});
  EXPECT_TRUE(place.names({{{"walls_aligned", {a, b}}, true}}).empty());
}

TEST(RelationsFound, WhatIsRefusedAsOneLineMayBeInParallel) {
  Place place;
  const auto a = place.addWall(kBox[0]), b = place.addWall(kBeside);
  EXPECT_EQ(place.names({{{"walls_aligned", {a, b}}, false}}), Names{"parallel"});
  EXPECT_TRUE(place.names({{{"walls_aligned", {a, b}}, false}, {{"wall_turn", {a, b}}, false}}).empty());
}

TEST(RelationsFound, TieNoSessionThatIsNotAligned) {
  Place place;
  place.map().sessions = {{0, "", {0, 0}, true}, {1, "", {1, 0}, false}};
  place.addWall(kBox[0]);
  place.addWall(kBeside, 1);
  EXPECT_TRUE(place.relations().empty());
  place.addWall({{9, 4}, {9, 0}}, 1);
  EXPECT_EQ(place.names(), Names{"perpendicular"}) << "within the session all is as ever";
  place.map().sessions[1].aligned = true;
  EXPECT_EQ(place.relations().size(), 2U);
}

// A floor determines that each wall is upright, but not the angles between walls.
TEST(RelationsFound, OfAFloorAndTwoWallsAreThreeRightAngles) {
  Place place;
  place.addPlane({{0, 0, 1}, 0}, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  place.addPlane({{1, 0, 0}, 0}, {{0, 0, 0}, {0, 4, 0}, {0, 4, 2}, {0, 0, 2}});
  place.addPlane({{0, 1, 0}, 0}, {{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}});
  const auto found = place.relations();
  EXPECT_EQ(found.size(), 3U);
  EXPECT_TRUE(place.relations(acting(found)).empty());
  // The wall across is parallel to one of them, and all other relations follow.
  place.addPlane({{-1, 0, 0}, 4}, {{4, 0, 0}, {4, 4, 0}, {4, 4, 2}, {4, 0, 2}});
  EXPECT_EQ(place.names(acting(found)), Names{"parallel"});
}

TEST(RelationsFound, OnePlaneIsRelatedThoughDirectionsAre) {
  Place place;
  const auto a = place.addPlane({{0, 1, 0}, 0}, {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}});
  const auto b = place.addPlane({{0, 1, 0}, 0}, {{5, 0, 0}, {7, 0, 0}, {7, 0, 2}, {5, 0, 2}});
  EXPECT_EQ(place.names(), Names{"on one plane"});
  const RelatedPair parallel{"planes_parallel", {a, b}}, aligned{"planes_aligned", {a, b}};
  const auto found = place.relations({{parallel, true}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].record.factor->kind(), "plane_shift");
  EXPECT_EQ(place.names({{aligned, false}}), Names{"parallel"});
}

// For example, an object on a table.
TEST(RelationsFound, PointsOnATableAreThoseWithinItsOutline) {
  Place place;
  const auto table =
      place.addPlane({{0, 0, 1}, -0.75}, {{1, 1, 0.75}, {2.2, 1, 0.75}, {2.2, 1.8, 0.75}, {1, 1.8, 0.75}});
  const auto on_top = place.addPoint({1.5, 1.4, 0.75});
  place.addPoint({1.5, 0.5, 0.75});
  place.addPoint({1.5, 1.4, 1.6});
  const auto found = place.relations();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "point on surface");
  EXPECT_EQ(found[0].record.variables, (std::vector<base::VariableId>{on_top, table}));
  EXPECT_TRUE(place.relations(acting(found)).empty());
}

// A wall that is oblique to the axes: the corners of its bounding box are far from it.
TEST(RelationsFound, PointsOnAWallAreNotBesideIt) {
  Place place;
  const Vector3d normal = Vector3d(1, 1, 0).normalized(), along(-normal.y(), normal.x(), 0);
  const auto at = [&](double distance, double z) -> Vector3d {
    return 2 * normal + distance * along + Vector3d(0, 0, z);
  };
  const auto wall = place.addPlane({-normal, 2}, {at(0, 0), at(3, 0), at(3, 2), at(0, 2)});
  const auto sign = place.addPoint(at(1, 1.5)), high = place.addPoint(at(3.1, 2.8));
  place.addPoint(at(3.5, 1.5));
  place.addPoint(at(-0.5, 1.5));
  std::vector<base::VariableId> points;
  for (const auto& relation : place.relations()) {
    EXPECT_EQ(relation.record.variables[1], wall);
    points.push_back(relation.record.variables[0]);
  }
  std::sort(points.begin(), points.end());
  EXPECT_EQ(points, (std::vector<base::VariableId>{sign, high})) << "the height of a wall may be seen only in part";
}

}  // namespace
}  // namespace omnimapper::plugins::relations_found_test
