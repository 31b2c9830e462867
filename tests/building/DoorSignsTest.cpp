#include <gtest/gtest.h>
#include <omnimapper/building/DoorSigns.h>
#include <omnimapper/building/Segmentation.h>

#include <cmath>

#include "PaintedPlan.h"

namespace omnimapper::building::door_signs_test {
namespace {

/// A corridor below three rooms, whose doors are at x = 1, 5 and 9 m and 0.9 m wide, in a wall at y = 2 m.
class DoorSigns : public ::testing::Test {
 protected:
  const Room& at(double x, double y) const { return *roomAt(storey_, {x, y}); }
  /// A sign on the side of the corridor.
  static DoorSign signAt(double x, const std::string& text) { return {"0:1", text, {x, 2}, {0, -1}}; }

  Storey storey_ = segmentRooms(corridorWithRooms().grid()).storey;
};

TEST_F(DoorSigns, aSignNamesTheRoomBehindTheDoorThatItHangsBeside) {
  ASSERT_EQ(storey_.rooms.size(), 4U);
  nameBySigns(storey_, {signAt(2.1, "213"), signAt(4.7, "Library")});
  EXPECT_EQ(at(2, 4).name, "213");
  EXPECT_EQ(at(5, 4).name, "Library");
  EXPECT_EQ(at(10, 4).name, "");
  EXPECT_EQ(at(6, 1).name, "") << "the corridor";
  EXPECT_GT(at(2, 4).name_confidence, 0.7);
  ASSERT_EQ(at(2, 4).why.size(), 1U);
  EXPECT_NE(at(2, 4).why[0].what.find("sign \"213\" (0:1), 0.2 m beside door"), std::string::npos)
      << at(2, 4).why[0].what;
  EXPECT_TRUE(storey_.unseen.empty());
}

TEST_F(DoorSigns, aSignThatIsReadFromInsideNamesWhatIsOutside) {
  nameBySigns(storey_, {{"0:2", "Hall", {2.2, 2.1}, {0, 1}}});
  EXPECT_EQ(at(6, 1).name, "Hall");
  EXPECT_EQ(at(2, 4).name, "");
}

TEST_F(DoorSigns, aDoorWhoseRoomWasNotSeenIsKnown) {
  nameBySigns(storey_, {{"0:3", "118", {6, 0}, {0, 1}}, {"0:4", "Exit", {8, 0}, {0, 1}}});
  ASSERT_EQ(storey_.unseen.size(), 1U) << "no room is called Exit";
  EXPECT_EQ(storey_.unseen[0].name, "118");
  EXPECT_EQ(storey_.unseen[0].seen_from, std::optional<int>(at(6, 1).id));
  EXPECT_EQ(storey_.unseen[0].door, Eigen::Vector2d(6, 0));
}

TEST_F(DoorSigns, aSignOnTheWallOfARoomWithNoDoorBesideItIsLessSure) {
  nameBySigns(storey_, {signAt(11.6, "214")});
  EXPECT_EQ(at(10, 4).name, "214") << "1.7 m from the door";
  EXPECT_LT(at(10, 4).name_confidence, 0.6);
}

TEST_F(DoorSigns, twoSignsThatDisagreeMakeTheNameDoubtful) {
  nameBySigns(storey_, {signAt(2.1, "213")});
  const double alone = at(2, 4).name_confidence;
  nameBySigns(storey_, {signAt(2.1, "213"), signAt(0.6, "217")});
  EXPECT_EQ(at(2, 4).name, "213");
  EXPECT_LT(at(2, 4).name_confidence, 0.7 * alone);
  EXPECT_EQ(at(2, 4).why.size(), 2U);
}

TEST_F(DoorSigns, namesOfUsersStayAndThoseOfEarlierSignsGo) {
  nameBySigns(storey_, {signAt(2.1, "213"), signAt(4.7, "215")});
  for (Room& room : storey_.rooms)
    if (room.name == "213") {
      room.name = "Ada's room";
      room.why.push_back({NameEvidence::Source::user, "renamed", 1});
    }
  nameBySigns(storey_, {signAt(2.1, "213")});
  EXPECT_EQ(at(2, 4).name, "Ada's room");
  EXPECT_EQ(at(5, 4).name, "") << "that sign is gone";
}

TEST(DoorSignsTurned, doNotDependOnTheDirectionOfTheGrid) {
  Storey storey = segmentRooms(corridorWithRooms(0.05, 0.4).grid()).storey;
  nameBySigns(storey, {{"0:1", "213", {2.1, 2}, {0, -1}}});
  ASSERT_NE(roomAt(storey, {2, 4}), nullptr);
  EXPECT_EQ(roomAt(storey, {2, 4})->name, "213");
}

}  // namespace
}  // namespace omnimapper::building::door_signs_test
