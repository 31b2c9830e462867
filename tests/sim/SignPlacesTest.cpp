// How many signs of the places in rawlogs/signs_*.ini are legible to cameras how often, by geometry.
#include <gtest/gtest.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <map>

namespace sign_places_test {
namespace {

using namespace omnimapper;

struct Place {
  const char* name;
  int signs;          // at least
  int repeated;       // smallest number of signs whose text other signs bear, too
  int on_two_visits;  // smallest number of signs that are legible on two visits
};

class SignPlaces : public ::testing::TestWithParam<Place> {
 protected:
  SignPlaces()
      : simulation_(base::Config::fromFile(
            omnimapper::testing::sourceFile("rawlogs/" + std::string(GetParam().name) + ".ini"))) {}

  const sim::World& world() const { return simulation_.world(); }

  sim::World withoutPeople() const {
    sim::World empty = world();
    const auto isPerson = [](const sim::Body& body) { return body.surfaces.front().kind == sim::SurfaceKind::person; };
    empty.bodies.erase(std::remove_if(empty.bodies.begin(), empty.bodies.end(), isPerson), empty.bodies.end());
    empty.people.clear();
    return empty;
  }

  void expectLegibleSigns() {
    const auto& sensors = simulation_.sensors();
    const sim::Sensor& camera =
        **std::find_if(sensors.begin(), sensors.end(), [](const auto& sensor) { return sensor->label() == "camera"; });
    const sim::World empty = withoutPeople();
    const sim::Scenes empty_scenes(empty);
    const sim::Scene empty_scene = empty_scenes.at(0);
    sim::SignCounter counter(world().signs.size()), unhidden = counter;
    for (int k = 0; k < camera.count(); ++k) {
      const sim::CameraView view = *camera.pictureView(k);
      counter.add(view.time, sim::signsInView(world(), simulation_.scenes(), simulation_.scenes().at(view.time), view));
      unhidden.add(view.time, sim::signsInView(empty, empty_scenes, empty_scene, view));
    }
    const int hidden = unhidden.pictures() - counter.pictures();
    const int all = static_cast<int>(world().signs.size()), thrice = counter.inPictures(3), twice = counter.onVisits(2);
    RecordProperty("signs", all);
    RecordProperty("legible_in_three_pictures", thrice);
    RecordProperty("legible_on_two_visits", twice);
    RecordProperty("hidden_by_people", hidden);
    EXPECT_GE(all, GetParam().signs);
    EXPECT_GE(thrice, 0.8 * all);
    EXPECT_GE(twice, GetParam().on_two_visits);
    EXPECT_GE(hidden, 5) << "of what is legible, in pictures that people stand in";
  }

  void expectRepeatedTextsAndNumbersThatAreNoSigns() const {
    std::map<std::vector<std::string>, int> times;
    for (const sim::Sign& sign : world().signs) ++times[sign.lines];
    int repeated = 0;
    for (const auto& [lines, count] : times) repeated += count > 1 ? count : 0;
    EXPECT_GE(repeated, GetParam().repeated);
    EXPECT_GE(times[{"EXIT"}], 3);
    const auto announcements = std::count_if(world().bodies.begin(), world().bodies.end(), [](const sim::Body& body) {
      return body.name.rfind("announcement_", 0) == 0;
    });
    EXPECT_GE(announcements, 3);
  }

  // The robot sees people but does not drive over them.
  void expectPeopleBesideTheRobot() const {
    constexpr double kTouching = 0.3;  // between the robot's middle and a joint [m]
    EXPECT_GE(world().people.size(), 2u);
    for (const sim::Person& person : world().people) {
      double nearest = 1e9;
      for (double time = 0; time < simulation_.duration(); time += 0.2) {
        const Eigen::Vector2d robot = simulation_.mapFromBase().at(time)->translation.head<2>();
        for (const auto& joint : person.joints)
          nearest = std::min(nearest, (joint.in_map.at(time)->translation.head<2>() - robot).norm());
      }
      EXPECT_GT(nearest, kTouching) << person.name;
      EXPECT_LT(nearest, 3) << person.name << " is never met";
    }
  }

  const sim::Simulation simulation_;
};

TEST_P(SignPlaces, haveLegibleSignsRepeatedTextsAndPeopleBeforeThem) {
  expectLegibleSigns();
  expectRepeatedTextsAndNumbersThatAreNoSigns();
  expectPeopleBesideTheRobot();
}

INSTANTIATE_TEST_SUITE_P(Rawlogs, SignPlaces,
                         ::testing::Values(Place{"signs_30", 12, 7, 8}, Place{"signs_200", 50, 14, 12},
                                           Place{"signs_400", 100, 20, 12}, Place{"signs_office", 20, 12, 8},
                                           Place{"signs_laboratory", 10, 6, 4}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace sign_places_test
