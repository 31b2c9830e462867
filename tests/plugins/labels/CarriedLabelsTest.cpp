// Labels of a map of a room that another map, in another frame and with other numbers, takes over.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/testing/HandMadeRun.h>

#include <map>

#include "labels/CarriedLabels.h"
#include "labels/PlaceLikeness.h"

namespace omnimapper::plugins::carried_labels_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Se2;

building::Room roomBetween(int id, double min_x, double min_y, double max_x, double max_y) {
  building::Room room;
  room.id = id;
  room.outline = {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
  return room;
}

map::Place box(const std::string& kind, double x, double y, double length, double width, double top) {
  map::Place place;
  place.kind = place.label = kind;
  place.position = {x, y, top};
  place.extent.outlines = {{{x - length / 2, y - width / 2},
                            {x + length / 2, y - width / 2},
                            {x + length / 2, y + width / 2},
                            {x - length / 2, y + width / 2}}};
  place.extent.bottom = place.extent.top = top;
  return place;
}

map::Place wall(double x, double y, double to_x, double to_y, const Vector3d& normal) {
  map::Place place;
  place.kind = place.label = "wall";
  place.position = {(x + to_x) / 2, (y + to_y) / 2, 1.2};
  place.extent.lines = {{{x, y}, {to_x, to_y}}};
  place.extent.top = 2.4;
  place.normal = normal;
  return place;
}

/// Two rooms with a wall of 0.1 m between them, tables, a chair and two cups 0.12 m apart.
class TwoMaps : public ::testing::Test {
 protected:
  TwoMaps() {
    earlier_.rooms = building::Storey{};
    earlier_.rooms->rooms = {roomBetween(1, 0, 0, 5, 4), roomBetween(2, 5.1, 0, 8, 4)};
    put(box("table", 2, 2, 1.4, 0.8, 0.75));
    put(box("table", 6.5, 1, 0.9, 0.9, 0.7));
    put(box("seat", 2, 1.2, 0.45, 0.45, 0.45));
    put(wall(5, 0.5, 5, 3.5, {-1, 0, 0}));
    put(wall(5.1, 0.5, 5.1, 3.5, {1, 0, 0}));
    put(box("object", 1.8, 2, 0.08, 0.08, 0.85));
    put(box("object", 1.92, 2, 0.08, 0.08, 0.85));
    put(box("object", 6.5, 1, 0.08, 0.08, 0.8));
    now_ = earlier_;
    for (auto& room : now_.rooms->rooms)
      for (auto& corner : room.outline) corner = kNowFromEarlier * corner;
    for (auto& place : now_.places.places) {
      place = movedPlace(kNowFromEarlier, place);
      place.id.index = 100 - place.id.index;
    }
    run_.addFrame(mrpt::poses::CPose3D(kNowFromEarlier.x, kNowFromEarlier.y, 0));
  }
  void put(map::Place place) {
    place.id = {0, static_cast<std::uint32_t>(earlier_.places.places.size())};
    earlier_.places.places.push_back(place);
  }
  void name(std::uint32_t landmark, const std::string& text) {
    map::Label label;
    label.text = text;
    label.landmark = base::LandmarkId{0, landmark};
    label.who = "anna";
    label.probability = 0.97;
    earlier_.labels.labels.push_back(label);
  }
  map::Place& now(std::uint32_t landmark) { return now_.places.places[landmark]; }
  /// The numbers of the landmarks that have the labels now, as the earlier map numbers them; -1 for lost ones.
  std::map<std::string, int> carried() {
    const auto motion = motionBetweenMaps(earlier_, now_);
    if (!motion) {
      ADD_FAILURE() << "the maps are not aligned";
      return {};
    }
    EXPECT_LT(minus(*motion, kNowFromEarlier).norm(), 0.02);
    const auto carried = carryLabels(earlier_, now_, *motion, run_.map.key_frames);
    std::map<std::string, int> numbers;
    for (const auto& [text, why_not] : carried.outcomes)
      if (!why_not.empty()) numbers[text] = -1;
    for (const auto& label : carried.labels) numbers[label.text] = 100 - static_cast<int>(label.landmark->index);
    labels_ = carried.labels;
    return numbers;
  }

  const Se2 kNowFromEarlier{7, -3, 2.2};
  LabelledMap earlier_, now_;
  std::vector<map::Label> labels_;
  testing::HandMadeRun run_;
};

TEST_F(TwoMaps, EachLabelIsOnTheSameThing) {
  for (const auto& [number, text] : std::map<std::uint32_t, std::string>{
           {0, "kitchen table"}, {1, "desk"}, {2, "my chair"}, {3, "west side"}, {4, "east side"}, {5, "cup"}})
    name(number, text);
  const std::map<std::string, int> expected{{"kitchen table", 0}, {"desk", 1},      {"my chair", 2},
                                            {"west side", 3},     {"east side", 4}, {"cup", 5}};
  EXPECT_EQ(carried(), expected);
  ASSERT_EQ(labels_.size(), 6U);
  EXPECT_EQ(labels_[0].who, "anna");
  EXPECT_EQ(labels_[0].probability, 0.97);
  EXPECT_EQ(labels_[0].frame, run_.map.key_frames.back().id);
}

TEST_F(TwoMaps, WhatIsGoneOrHasAnotherSizeIsNotAnythingElse) {
  name(0, "kitchen table");
  name(1, "desk");
  name(7, "cup");
  now(0) = movedPlace(kNowFromEarlier, box("table", 2, 2, 3.4, 0.8, 0.75));  // another table stands there
  now(0).id = {0, 100};
  now(1).kind = now(1).label = "bed";  // its class is seen otherwise, at the same place and size
  now(7).position.x() += 0.5;          // the cup was carried away
  for (auto& corner : now(7).extent.outlines[0]) corner.x() += 0.5;
  const std::map<std::string, int> expected{{"kitchen table", -1}, {"desk", 1}, {"cup", -1}};
  EXPECT_EQ(carried(), expected);
}

TEST_F(TwoMaps, OfTwoThatMayBeItNoneIs) {
  name(5, "cup");
  for (const std::uint32_t number : {5U, 6U}) {
    auto& cup = now(number);
    const Vector2d middle = kNowFromEarlier * Vector2d(number == 5 ? 1.74 : 1.86, 2);
    const Vector2d shift = middle - cup.position.head<2>();
    cup.position.head<2>() += shift;
    for (auto& corner : cup.extent.outlines[0]) corner += shift;
  }
  EXPECT_EQ(carried().at("cup"), -1);
}

TEST_F(TwoMaps, APlaceStaysIfTheRobotWasNear) {
  for (const auto& [x, text] : std::map<double, std::string>{{1, "charger"}, {7, "far corner"}}) {
    map::Label label;
    label.text = text;
    earlier_.labels.labels.push_back(label);
    map::Place place;
    place.kind = "place";
    place.label = text;
    place.position = {x, 1, 0};
    place.id = {0, 4294967295U - static_cast<std::uint32_t>(x)};
    earlier_.places.places.push_back(place);
  }
  const auto motion = motionBetweenMaps(earlier_, now_);
  ASSERT_TRUE(motion);
  const auto carried = carryLabels(earlier_, now_, *motion, run_.map.key_frames);
  ASSERT_EQ(carried.labels.size(), 1U);
  EXPECT_EQ(carried.labels[0].text, "charger");
  EXPECT_FALSE(carried.labels[0].landmark);
  const Vector2d there = kNowFromEarlier * Vector2d(1, 1);
  EXPECT_LT((carried.labels[0].in_frame - Vector3d(there.x() - 7, there.y() + 3, 0)).norm(), 0.03);
}

TEST_F(TwoMaps, AnotherBuildingAndMapsWithoutRoomsAreNotAligned) {
  LabelledMap other = now_;
  other.rooms->rooms = {roomBetween(1, 0, 0, 30, 2)};
  EXPECT_FALSE(motionBetweenMaps(earlier_, other));
  other.rooms.reset();
  EXPECT_FALSE(motionBetweenMaps(earlier_, other));
}

TEST(LabelledMap, ThatCannotBeReadIsRefusedBeforeTheRun) {
  EXPECT_THROW(readLabelledMap("/nowhere"), base::Error);
}

}  // namespace
}  // namespace omnimapper::plugins::carried_labels_test
