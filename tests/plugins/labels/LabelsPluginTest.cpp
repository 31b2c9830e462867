#include <gtest/gtest.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/query/Find.h>

#include <limits>

#include "Tour.h"

namespace omnimapper::plugins::labels_test {
namespace {

const Vector3d kTable(1.2, -1.7, 0.7), kFarCup(1.8, 1.6, 1.0), kCups(0.83, -1.5, 0.75);

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LabelsPlugin, whatIsPointedAtGetsTheName) {
  Tour tour;
  tour.command("kitchen table", obs::CommandSubject::map);
  tour.point(kTable);
  const auto labels = tour.labels().labels;
  ASSERT_EQ(labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(labels[0].text, "kitchen table");
  EXPECT_EQ(labels[0].landmark, tour.table);
  EXPECT_EQ(labels[0].who, "anna");
  EXPECT_EQ(labels[0].when, base::stampFromUnix(1.6e9));
  EXPECT_LT((labels[0].in_frame - Vector3d(1.2, -1.7, 0.7)).norm(), 1e-6);
  EXPECT_GT(labels[0].probability, 0.95);
  tour.point(kFarCup);
  EXPECT_EQ(tour.labels().labels.size(), 1u) << "nobody asked for that";
}

TEST(LabelsPlugin, anObjectIsMeantWhereAnObjectIsAskedFor) {
  Tour tour;
  tour.command("my cup", obs::CommandSubject::object);
  tour.point(kFarCup);
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].landmark, tour.far_cup);
}

TEST(LabelsPlugin, ofTwoThatAreCloseItAsksWhich) {
  Tour tour;
  tour.command("my cup", obs::CommandSubject::object);
  tour.point(kCups);
  EXPECT_TRUE(tour.labels().labels.empty());
  const auto question = tour.labels().question;
  ASSERT_TRUE(question) << tour.lastReason();
  ASSERT_EQ(question->choices.size(), 2u);
  tour.edit("choose 3");
  EXPECT_TRUE(tour.labels().labels.empty());
  EXPECT_EQ(tour.lastReason(), "choose needs a number from 1 to 2");
  tour.edit("choose 2");
  ASSERT_EQ(tour.labels().labels.size(), 1u);
  EXPECT_EQ(tour.labels().labels[0].landmark, question->choices[1].landmark);
  EXPECT_FALSE(tour.labels().question);
}

TEST(LabelsPlugin, aPlaceIsNamedWithoutAGesture) {
  Tour tour;
  tour.command("charger", obs::CommandSubject::place);
  ASSERT_EQ(tour.labels().labels.size(), 1u);
  EXPECT_FALSE(tour.labels().labels[0].landmark);
}

TEST(LabelsPlugin, aRequestThatNobodyAnswersEndsAndSaysWhy) {
  Tour tour;
  tour.command("table", obs::CommandSubject::any, 5);
  tour.wait(6);
  tour.point(kTable);
  EXPECT_TRUE(tour.labels().labels.empty());
  EXPECT_EQ(tour.lastReason(), "the label 'table' was not given: nobody was seen");
  tour.command("table");
  tour.show(CObservationSkeleton());
  tour.end();
  EXPECT_EQ(tour.lastReason(),
            "the label 'table' was not given: nobody was seen (no hand is known together with its elbow or the head)");
  Tour nowhere;
  nowhere.command("star");
  nowhere.point({-2, 0, 9});
  nowhere.end();
  EXPECT_TRUE(nowhere.labels().labels.empty());
}

TEST(LabelsPlugin, whatIsMappedAfterTheGestureAnswersTheRequestThatWaits) {
  Tour tour;
  const Vector3d lamp(-1, -3, 2.5);
  tour.command("lamp", obs::CommandSubject::map);
  tour.point(lamp);
  EXPECT_TRUE(tour.labels().labels.empty()) << "nothing is there yet";
  const auto id = tour.add(surface("wall", {lamp + Vector3d(-1, 0.5, -0.5), lamp + Vector3d(1, -0.5, -0.5),
                                            lamp + Vector3d(1, -0.5, 0.5), lamp + Vector3d(-1, 0.5, 0.5)}));
  tour.run.addFrame({});
  tour.show(CObservationSkeleton());
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].landmark, id);
}

// The camera has seen the floor under a table, but not the table.
TEST(LabelsPlugin, theFloorBehindWhatIsNotMappedYetIsNotMeant) {
  Tour tour;
  tour.add(surface("floor", {{-1, -3, 0}, {5, -3, 0}, {5, 3, 0}, {-1, 3, 0}}));
  auto* table = tour.run.map.landmarks.edit(tour.table);
  const auto payload = table->payload;
  table->payload = std::make_shared<FixedShape>(surface("table", {{9, 9, 0}, {9.1, 9, 0}, {9.1, 9.1, 0}}));
  tour.command("kitchen table", obs::CommandSubject::map);
  tour.point(kTable);
  EXPECT_TRUE(tour.labels().labels.empty()) << tour.lastReason();
  tour.run.map.landmarks.edit(tour.table)->payload = payload;
  tour.run.addFrame({});
  tour.show(CObservationSkeleton());
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].landmark, tour.table);
}

// The camera sees walls up to 1.2 m; people point at them at the height of their eyes.
TEST(LabelsPlugin, aWallIsMeantAboveWhatTheCameraSawOfIt) {
  Tour tour;
  for (const auto id : {tour.left_wall, tour.back_wall}) {
    auto* wall = tour.run.map.landmarks.edit(id);
    wall->payload = std::make_shared<FixedShape>(
        id == tour.left_wall ? surface("wall", {{-1, 3, 0}, {5, 3, 0}, {5, 3, 1.2}, {-1, 3, 1.2}})
                             : surface("wall", {{5, -3, 0}, {5, 3, 0}, {5, 3, 1.2}, {5, -3, 1.2}}));
  }
  tour.command("west wall", obs::CommandSubject::map);
  tour.point({2, 3, 1.8}, {1.8, 0.5, 1.4});
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].landmark, tour.left_wall);
}

TEST(LabelsPlugin, aRequestWithoutAnAnswerLeavesNoLayer) {
  Tour tour;
  tour.command("table", obs::CommandSubject::map);
  tour.end();
  EXPECT_EQ(tour.run.map.layers.find<map::Labels>(), nullptr);
  tour.command("my cup", obs::CommandSubject::object, 5);
  tour.point(kCups);
  ASSERT_TRUE(tour.labels().question);
  tour.end();
  EXPECT_EQ(tour.run.map.layers.find<map::Labels>(), nullptr) << "the question was not answered";
}

TEST(LabelsPlugin, anEditLeavesARequestThatWaits) {
  Tour tour;
  tour.command("charger", obs::CommandSubject::place);
  tour.command("table", obs::CommandSubject::map);
  tour.edit("rename charger = dock");
  tour.point(kTable);
  ASSERT_EQ(tour.labels().labels.size(), 2u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[1].text, "table");
}

TEST(LabelsPlugin, aQuestionThatNobodyAnsweredCannotBeAnsweredLater) {
  Tour tour;
  tour.command("my cup", obs::CommandSubject::object, 5);
  tour.point(kCups);
  ASSERT_TRUE(tour.labels().question);
  tour.wait(60);
  tour.edit("choose 1");
  EXPECT_EQ(tour.lastReason(), "there is no question");
  EXPECT_TRUE(tour.labels().labels.empty());
  EXPECT_FALSE(tour.labels().question);
}

TEST(LabelsPlugin, badLabelsAreRefused) {
  Tour tour;
  for (const std::string& text : {std::string(1 << 20, 'x'), std::string("\x1b[2Jtable"), std::string("  "),
                                  std::string("a\nb"), std::string("\xff")}) {
    tour.command(text);
    tour.point(kTable);
    EXPECT_TRUE(tour.labels().labels.empty()) << text.size();
    EXPECT_LT(tour.lastReason().size(), 300u);
    EXPECT_EQ(tour.lastReason().find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(tour.reasons.size(), 5u);
}

TEST(LabelsPlugin, skeletonsOfNoUseAreNoGestures) {
  Tour tour;
  tour.command("table", obs::CommandSubject::map);
  auto nan = Tour::skeleton(kTable, {1.8, -0.3, 1.2});
  nan.right_hand.x = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 10; ++k) tour.show(nan);
  EXPECT_TRUE(tour.labels().labels.empty());
  auto millimetres = Tour::skeleton(kTable, {1.8, -0.3, 1.2});
  for (auto* joint : {&millimetres.head, &millimetres.torso, &millimetres.right_hand, &millimetres.right_elbow,
                      &millimetres.left_shoulder, &millimetres.right_shoulder})
    joint->x *= 1000, joint->y *= 1000, joint->z *= 1000;
  for (int k = 0; k < 10; ++k) tour.show(millimetres);
  EXPECT_EQ(tour.labels().labels.size(), 1u) << "millimetres are recognised: " << tour.lastReason();
}

// One person points at the table, another, nearer to the robot, at the cup: the nearer one is in control.
TEST(LabelsPlugin, ofTwoWhoPointTheOneInControlCounts) {
  Tour tour;
  tour.command("thing", obs::CommandSubject::object);
  for (int k = 0; k < 10; ++k) {
    tour.show(Tour::skeleton(kTable, {2.6, -0.6, 1.2}));
    tour.show(Tour::skeleton(kFarCup, {1.2, 0.9, 1.2}));
  }
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].landmark, tour.far_cup);
}

TEST(LabelsPlugin, whatIsTouchedOnAPageIsNamedWithoutAGesture) {
  Tour tour;
  tour.edit("name " + toString(tour.table) + " = kitchen = table");
  ASSERT_EQ(tour.labels().labels.size(), 1u) << tour.lastReason();
  EXPECT_EQ(tour.labels().labels[0].text, "kitchen = table");
  EXPECT_EQ(tour.labels().labels[0].landmark, tour.table);
  EXPECT_EQ(tour.labels().labels[0].probability, 1);
  tour.edit("name " + toString(tour.table) + " = kitchen = table");
  EXPECT_TRUE(contains(tour.lastReason(), "already"));
  tour.edit("name 0:9999 = x");
  EXPECT_EQ(tour.lastReason(), "there is no landmark 0:9999 to be named");
  tour.edit("name " + toString(tour.table) + " =  ");
  EXPECT_TRUE(contains(tour.lastReason(), "is empty"));
  EXPECT_EQ(tour.labels().labels.size(), 1u);
}

TEST(LabelsPlugin, editsRenameDeleteAndUndo) {
  Tour tour;
  tour.command("a", obs::CommandSubject::place);
  tour.edit("rename a = Tom's corner");
  EXPECT_EQ(tour.labels().labels[0].text, "Tom's corner");
  tour.edit("delete Tom's corner");
  EXPECT_TRUE(tour.labels().labels.empty());
  tour.edit("undo");
  tour.edit("undo");
  ASSERT_EQ(tour.labels().labels.size(), 1u);
  EXPECT_EQ(tour.labels().labels[0].text, "a");
  tour.edit("undo");
  tour.edit("undo");
  EXPECT_EQ(tour.lastReason(), "there is nothing to undo in this run");
  tour.edit("delete b");
  EXPECT_EQ(tour.lastReason(), "there is no label 'b'");
  tour.edit("rename b");
  EXPECT_EQ(tour.lastReason(), "rename needs OLD = NEW");
  tour.edit("explode \x1b[2J");
  EXPECT_TRUE(contains(tour.lastReason(), "no edit of labels"));
}

std::string titlesOf(const map::Places& places, const std::string& text) {
  std::string found;
  for (const auto& each : query::find(places.places, text).places) found += each.place->label + ";";
  return found;
}

TEST(LabelsPlugin, whatHasANameIsFoundByItAlsoAfterAMerge) {
  Tour tour;
  tour.command("kitchen table", obs::CommandSubject::map);
  tour.point(kTable);
  EXPECT_EQ(titlesOf(derived::placesOf(tour.run.view()), "kitchen table"), "table;");
  const auto merged = tour.add(surface("desk", {{0.4, -2.3, 0.7}, {2, -2.3, 0.7}, {2, -1.1, 0.7}, {0.4, -1.1, 0.7}}));
  auto* landmark = tour.run.map.landmarks.edit(tour.table);
  landmark->state = map::Landmark::State::merged;
  landmark->merged_into = merged;
  EXPECT_EQ(titlesOf(derived::placesOf(tour.run.view()), "kitchen table"), "desk;");
}

TEST(LabelsPlugin, severalSurfacesOfOneNameAreARegion) {
  Tour tour;
  for (const Vector3d& wall : {Vector3d(2, 3, 1.3), Vector3d(5, 0, 1.3)}) {
    tour.command("hall", obs::CommandSubject::map);
    tour.point(wall, wall.y() > 2 ? Vector3d(1.8, 0.5, 1.2) : Vector3d(2.4, 0, 1.2));
  }
  ASSERT_EQ(tour.labels().labels.size(), 2u) << tour.lastReason();
  tour.command("charger", obs::CommandSubject::place);
  const auto places = derived::placesOf(tour.run.view());
  const auto found = query::find(places.places, "hall");
  ASSERT_EQ(found.places.size(), 1u);
  const map::Place& hall = *found.places[0].place;
  EXPECT_EQ(hall.kind, "region");
  ASSERT_EQ(hall.extent.outlines.size(), 1u);
  // The hull of the walls along y = 3 and x = 5 is a triangle.
  EXPECT_EQ(hall.extent.outlines[0].size(), 3u);
  EXPECT_EQ(titlesOf(places, "charger"), "charger;");
  for (const map::Place& place : places.places) {
    const auto by_id = query::find(places.places, toString(place.id)).places;
    ASSERT_EQ(by_id.size(), 1u) << toString(place.id);
    EXPECT_EQ(by_id[0].place, &place) << "an id is that of one place: " << place.label;
  }
}

}  // namespace
}  // namespace omnimapper::plugins::labels_test
