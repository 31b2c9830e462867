#include <gtest/gtest.h>
#include <omnimapper/query/RoomsAsked.h>

#include "TwoRooms.h"

namespace omnimapper::query::rooms_asked_test {
namespace {

using RoomsAsked = TwoRooms;

TEST_F(RoomsAsked, ARoomIsFoundByItsNameKindAndNumber) {
  const auto first = [&](const std::string& text) {
    const auto found = findRooms(map_, text);
    return found.empty() ? 0 : found.front().room ? found.front().room->id : -1;
  };
  EXPECT_EQ(first("kitchen"), 1);
  EXPECT_EQ(first("the Kitchen"), 1);
  EXPECT_EQ(first("room 2"), 2);
  EXPECT_EQ(first("room 118"), -1) << "not seen";
  EXPECT_EQ(first("119"), 0);
  EXPECT_EQ(first("bathroom"), 0);
  map_.rooms->rooms[0].kind_confidence = 0.5;
  EXPECT_EQ(first("kitchen"), 0) << "not sure";
}

TEST_F(RoomsAsked, AThingOnAWallIsInTheRoomThatItFaces) {
  map::Place sign = signAt(4.05, 3, "213");
  sign.normal = Eigen::Vector3d(-1, 0, 0);
  EXPECT_EQ(roomOf(*map_.rooms, sign)->id, 1);
  sign.normal = Eigen::Vector3d(1, 0, 0);
  EXPECT_EQ(roomOf(*map_.rooms, sign)->id, 2);
  EXPECT_EQ(roomOf(*map_.rooms, thingAt(8.2, 2, "seat"))->id, 2) << "0.3 m behind the wall";
  EXPECT_EQ(roomOf(*map_.rooms, thingAt(20, 2, "seat")), nullptr);
}

}  // namespace
}  // namespace omnimapper::query::rooms_asked_test
