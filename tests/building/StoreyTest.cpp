#include <gtest/gtest.h>
#include <omnimapper/building/Storey.h>

#include <cmath>

namespace omnimapper::building::storey_test {
namespace {

/// A square of 4 m with a hole of 1 m in its middle.
Room ring() {
  Room room;
  room.id = 3;
  room.outline = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  room.holes = {{{1.5, 1.5}, {1.5, 2.5}, {2.5, 2.5}, {2.5, 1.5}}};
  room.centre = {1, 1};
  return room;
}

TEST(Storey, aRoomHasThePointsInItsOutlineAndInNoHole) {
  const Room room = ring();
  EXPECT_TRUE(contains(room, {1, 1}));
  EXPECT_FALSE(contains(room, {2, 2})) << "in the hole";
  EXPECT_FALSE(contains(room, {5, 2}));
  EXPECT_FALSE(contains(Room(), {0, 0})) << "no outline";
  Storey storey;
  storey.rooms = {room};
  ASSERT_NE(roomAt(storey, {3.5, 3.5}), nullptr);
  EXPECT_EQ(roomAt(storey, {3.5, 3.5})->id, 3);
  EXPECT_EQ(roomAt(storey, {2, 2}), nullptr);
  EXPECT_EQ(roomOf(storey, 3), &storey.rooms.front());
  EXPECT_EQ(roomOf(storey, 4), nullptr);
}

TEST(Storey, aThingOnAWallIsInTheRoomThatItFaces) {
  Storey storey;
  storey.rooms = {ring(), ring()};
  storey.rooms[1].id = 4;
  storey.rooms[1].outline = {{4.1, 0}, {8, 0}, {8, 4}, {4.1, 4}};
  storey.rooms[1].holes.clear();
  const auto roomOfThingAt = [&](double x, double y, const std::optional<Eigen::Vector2d>& free_side) {
    const Room* room = roomOfThing(storey, {x, y}, free_side);
    return room ? room->id : 0;
  };
  EXPECT_EQ(roomOfThingAt(4.05, 3, Eigen::Vector2d(-1, 0)), 3);
  EXPECT_EQ(roomOfThingAt(4.05, 3, Eigen::Vector2d(1, 0)), 4);
  EXPECT_EQ(roomOfThingAt(8.3, 2, std::nullopt), 4) << "0.3 m behind the wall";
  EXPECT_EQ(roomOfThingAt(20, 2, std::nullopt), 0);
  const auto near = nearestRoom(storey, {10, 2});
  ASSERT_TRUE(near);
  EXPECT_EQ(near->room->id, 4);
  EXPECT_NEAR(near->distance, 2, 1e-9);
  EXPECT_FALSE(nearestRoom({}, {0, 0}));
}

TEST(Storey, aNameComesBeforeASureKindAndThatBeforeTheNumber) {
  Room room = ring();
  EXPECT_EQ(nameOf(room), "room 3");
  EXPECT_EQ(labelOf(room), "3");
  room.kind = "kitchen";
  room.kind_confidence = 0.6;
  EXPECT_EQ(nameOf(room), "room 3") << "not sure";
  room.kind_confidence = 0.9;
  EXPECT_EQ(nameOf(room), "kitchen");
  room.name = "213";
  EXPECT_EQ(nameOf(room), "213");
  EXPECT_EQ(labelOf(room), "213 (3)");
}

TEST(Storey, roomsAndTheirDoorsMoveWithTheirKeyFrames) {
  Storey storey;
  storey.rooms = {ring(), ring()};
  storey.rooms[1].id = 4;
  storey.rooms[0].anchor = Anchor{{0, 7}, {1, 1, 0}};
  Door door;
  door.rooms = {3, 4};
  door.opening = {{4, 1}, {4, 2}};
  storey.doors = {door};
  UnseenRoom unseen;
  unseen.door = {0, 2};
  unseen.seen_from = 3;
  storey.unseen = {unseen};
  // The key frame at (1, 1) is now at (1, 2), turned by a quarter: (4, 1), 3 m ahead of it, is 3 m to its left.
  const Storey moved = movedWith(storey, [](base::KeyFrameId id) -> std::optional<geometry::Se2> {
    if (id.index != 7) return std::nullopt;
    return geometry::Se2{1, 2, M_PI / 2};
  });
  EXPECT_LT((moved.doors[0].opening.from - Eigen::Vector2d(1, 5)).norm(), 1e-9);
  EXPECT_LT((moved.rooms[0].outline[1] - Eigen::Vector2d(2, 5)).norm(), 1e-9) << "(4, 0): 3 m ahead, 1 m to the right";
  EXPECT_LT((moved.unseen[0].door - Eigen::Vector2d(0, 1)).norm(), 1e-9);
  EXPECT_EQ(moved.rooms[0].anchor->map_from_frame.y, 2);
  EXPECT_EQ(moved.rooms[1].outline[1], storey.rooms[1].outline[1]) << "it has no anchor";
}

}  // namespace
}  // namespace omnimapper::building::storey_test
