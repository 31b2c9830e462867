#include <gtest/gtest.h>
#include <omnimapper/testing/HandMadeRun.h>

#include "TableWorld.h"
#include "object_landmarks/ObjectPieces.h"

namespace omnimapper::plugins::object_pieces_test {
namespace {

using Eigen::Vector3d;

constexpr double kTable = 0.7;  // [m] height of the table on which all objects stand

class ObjectPieces : public ::testing::Test {
 protected:
  ObjectPieces() : frame_(run_.addFrame({}).id) {}
  // Adds an object with points on the sides of a box along the axes of the map; `bottom`: above the table [m].
  base::LandmarkId add(double x, double y, double bottom, const Vector3d& size) {
    ObjectView view;
    view.frame = frame_;
    constexpr int kSteps = 12;
    for (int i = 0; i <= kSteps; ++i)
      for (int k = 0; k <= kSteps; ++k)
        for (const double side : {-0.5, 0.5}) {
          const double a = static_cast<double>(i) / kSteps - 0.5, b = static_cast<double>(k) / kSteps - 0.5;
          for (const Vector3d& at : {Vector3d(side, a, b), Vector3d(a, side, b), Vector3d(a, b, side)})
            view.points.push_back(
                (Vector3d(x, y, kTable + bottom + 0.5 * size.z()) + at.cwiseProduct(size)).cast<float>());
        }
    const base::LandmarkId id{0, static_cast<std::uint32_t>(objects_.size())};
    objects_.push_back({id, {ObjectModel({view}), run_.map.key_frames}, bottom});
    return id;
  }
  std::map<base::LandmarkId, base::LandmarkId> found() const { return findPieces(objects_); }

  testing::HandMadeRun run_;
  base::KeyFrameId frame_;
  std::vector<PieceCandidate> objects_;
};

TEST_F(ObjectPieces, ThingsThatStandOnOneAnotherOrTouchAreNone) {
  add(0, 0, 0, {0.2, 0.2, 0.12});         // a box
  add(0.02, 0, 0.12, {0.08, 0.08, 0.1});  // with a cup on it
  add(0.14, 0, 0, {0.08, 0.08, 0.25});    // a bottle that touches the box
  add(0.21, 0, 0, {0.06, 0.06, 0.12});    // a can that touches the bottle
  add(0.21, 0, 0.12, {0.09, 0.09, 0.1});  // a cup that is wider than the can on which it stands
  EXPECT_TRUE(found().empty());
}

TEST_F(ObjectPieces, AShadeBelongsToThePostThatIsTooThinToCarryIt) {
  const auto post = add(0, 0, 0, {0.03, 0.03, 0.3});
  const auto shade = add(0, 0, 0.28, {0.26, 0.26, 0.17});
  const auto pieces = found();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(pieces.count(post) + pieces.count(shade) == 1);
}

TEST_F(ObjectPieces, APostBelongsToItsFoot) {
  add(0, 0, 0, {0.16, 0.16, 0.07});
  add(0, 0, 0.07, {0.03, 0.03, 0.25});
  EXPECT_EQ(found().size(), 1U);
}

TEST_F(ObjectPieces, LeavesThatHangInTheAirBelongToTheirPot) {
  add(0, 0, 0, {0.2, 0.2, 0.18});         // a pot
  add(0.13, 0, 0.19, {0.16, 0.04, 0.1});  // a leaf that leans out
  add(0.24, 0, 0.28, {0.16, 0.04, 0.1});  // another one beyond it
  const auto pieces = found();
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces.begin()->second, pieces.rbegin()->second);
}

TEST_F(ObjectPieces, InsideAndOutsideOfABowlAreOne) {
  add(0, 0, 0, {0.16, 0.16, 0.08});
  add(0.02, 0, 0.01, {0.12, 0.14, 0.07});
  EXPECT_EQ(found().size(), 1U);
}

TEST_F(ObjectPieces, WhatLiesInALargerThingIsNone) {
  add(0, 0, 0, {0.33, 0.3, 0.22});          // the box around an open laptop
  add(0.1, 0.05, 0.02, {0.08, 0.08, 0.1});  // a cup on its keys
  EXPECT_TRUE(found().empty());
}

TEST_F(ObjectPieces, WhatIsHiddenBelowByANearerThingIsNone) {
  add(0, 0, 0, {0.2, 0.1, 0.12});
  add(0, 0.12, 0.11, {0.2, 0.08, 0.1});  // behind it; its lower half was never seen
  EXPECT_TRUE(found().empty());
}

}  // namespace
}  // namespace omnimapper::plugins::object_pieces_test
