#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sign_landmarks/SignPayload.h"

// Drives past beacons whose numbers are written on signs: what a camera sees of them is a direction and a text.
namespace omnimapper::plugins::sign_landmarks_plugin_test {
namespace {

using mrpt::obs::CObservation;
using obs::CObservationDoorSigns;
using testing::SimulatedLog;

const std::string kIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = signs
[odometry]
class = OdometryPlugin
[signs]
class = SignLandmarksPlugin
pan_sigma_deg = 1
tilt_sigma_deg = 1
)";

testing::SimulatedLogOptions drive(double laps, std::uint64_t seed = 1) {
  testing::SimulatedLogOptions options;
  options.lasers.clear();
  options.beacons.on = true;
  options.laps = laps;
  options.seed = seed;
  return options;
}

using TextOf = std::function<std::string(int number)>;
std::string numbered(int number) {
  return std::to_string(200 + number);
}

/// The log, its beacons as signs.
std::vector<CObservation::Ptr> signsOf(const SimulatedLog& log, const TextOf& text_of = numbered) {
  auto observations = log.observations();
  for (auto& observation : observations) {
    const auto seen = std::dynamic_pointer_cast<mrpt::obs::CObservationBearingRange>(observation);
    if (!seen) continue;
    auto signs = CObservationDoorSigns::Create();
    signs->timestamp = seen->timestamp;
    signs->sensorLabel = "camera.signs";
    signs->source_label = "camera";
    const auto base_from_sensor = geometry::fromMrpt(seen->sensorLocationOnRobot);
    signs->sensorPose = geometry::toMrpt(base_from_sensor * geometry::sensorFromOptical());
    for (const auto& point : seen->sensedData) {
      const auto yaw = static_cast<double>(point.yaw), pitch = static_cast<double>(point.pitch);
      const Eigen::Vector3d direction(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                                      -std::sin(pitch));
      obs::ObservedDoorSign sign;
      sign.ray = geometry::inverse(geometry::sensorFromOptical()).rotation * direction;
      sign.texts = {{text_of(point.landmarkID), 0.97}};
      if (!sign.texts.front().text.empty()) signs->signs.push_back(sign);
    }
    observation = signs;
  }
  return observations;
}

struct Mapped {
  explicit Mapped(const SimulatedLog& log, const std::vector<CObservation::Ptr>& observations)
      : engine(testing::makeEngine(kIni)) {
    testing::run(*engine, observations);
    const auto view = engine->view();
    error = testing::trajectoryError(view, log);
    const mrpt::poses::CPose3D truth_from_map(log.truthAt(view.map.key_frames.front().stamp));
    for (const auto& [id, landmark] : view.map.landmarks) {
      if (landmark.state != map::Landmark::State::active) continue;
      const auto& payload = dynamic_cast<const SignPayload&>(*landmark.payload);
      EXPECT_EQ(landmark.evidence, payload.sightings());
      const Eigen::VectorXd& at = view.graph.value(landmark.variables.front());
      mrpt::math::TPoint3D there;
      truth_from_map.composePoint({at[0], at[1], at[2]}, there);
      signs[payload.title()].emplace_back(there.x, there.y, there.z);
    }
  }
  std::size_t accepted(const std::string& kind) const {
    const auto view = engine->view();
    return static_cast<std::size_t>(
        std::count_if(view.decisions.begin(), view.decisions.end(),
                      [&](const mapper::Decision& decision) { return decision.accepted && decision.kind == kind; }));
  }

  std::unique_ptr<mapper::Engine> engine;
  double error;
  std::map<std::string, std::vector<Eigen::Vector3d>> signs;  // where they are, by title
};

TEST(SignLandmarksPlugin, DirectionsAloneShowEverySignOnceWhereItIs) {
  const auto options = drive(1);
  const SimulatedLog log(options);
  const Mapped mapped(log, signsOf(log));
  int found = 0;
  for (std::size_t i = 0; i < options.beacons.positions.size(); ++i) {
    const auto sign = mapped.signs.find(numbered(static_cast<int>(i)));
    if (sign == mapped.signs.end()) continue;
    ++found;
    EXPECT_EQ(sign->second.size(), 1U) << sign->first << " stands twice in the map";
    EXPECT_LT((sign->second.front() - options.beacons.positions[i]).norm(), 0.25) << sign->first;
  }
  EXPECT_GE(found, static_cast<int>(options.beacons.positions.size()) - 1);
}

TEST(SignLandmarksPlugin, ASignThatIsMetAgainClosesTheLoop) {
  const SimulatedLog log(drive(2));
  const Mapped with(log, signsOf(log)), without(log, signsOf(log, [](int) { return ""; }));
  EXPECT_GT(with.accepted("same sign"), 2U);
  EXPECT_LT(with.error, 0.6 * without.error);
  for (const auto& [title, places] : with.signs) EXPECT_EQ(places.size(), 1U) << title;
}

TEST(SignLandmarksPlugin, TheThirdVisitClosesTheLoopToo) {
  const SimulatedLog log(drive(3));
  const Mapped mapped(log, signsOf(log));
  EXPECT_GT(mapped.accepted("same sign"), 10U);
  for (const auto& [title, places] : mapped.signs) EXPECT_EQ(places.size(), 1U) << title;
  const auto view = mapped.engine->view();
  for (const auto& [id, landmark] : view.map.landmarks) {
    if (landmark.state != map::Landmark::State::active) continue;
    EXPECT_FALSE(dynamic_cast<const SignPayload&>(*landmark.payload).is_repeated);
  }
}

// Two doors with one word: neither is taken for the other, and both are in the map.
TEST(SignLandmarksPlugin, AWordThatIsRepeatedClosesNothing) {
  const auto options = drive(2);
  const SimulatedLog log(options);
  const Mapped mapped(log, signsOf(log, [&](int number) { return number % 2 == 0 ? "Women" : numbered(number); }));
  const Mapped truly(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * truly.error + 0.02);
  ASSERT_EQ(mapped.signs.count("WOMEN"), 1U);
  std::set<std::size_t> met;
  for (const auto& place : mapped.signs.at("WOMEN")) {
    const auto nearest =
        std::min_element(options.beacons.positions.begin(), options.beacons.positions.end(),
                         [&](const auto& a, const auto& b) { return (a - place).norm() < (b - place).norm(); });
    EXPECT_LT((*nearest - place).norm(), 0.4);
    const auto number = static_cast<std::size_t>(nearest - options.beacons.positions.begin());
    EXPECT_EQ(number % 2, 0U);
    EXPECT_TRUE(met.insert(number).second) << "a sign stands twice in the map";
  }
}

TEST(SignLandmarksPlugin, ASightingOfAnUnknownOneWaitsAndSaysSo) {
  const SimulatedLog log(drive(1));
  auto observations = signsOf(log);
  int left = 2;  // of three directions that are needed
  for (auto& observation : observations) {
    if (auto* seen = dynamic_cast<CObservationDoorSigns*>(observation.get())) {
      if (left == 0) seen->signs.clear();
      if (!seen->signs.empty()) {
        seen->signs.resize(1);
        --left;
      }
    }
  }
  const Mapped mapped(log, observations);
  EXPECT_TRUE(mapped.signs.empty());
  const auto view = mapped.engine->view();
  EXPECT_TRUE(std::all_of(view.decisions.begin(), view.decisions.end(), [](const mapper::Decision& decision) {
    return decision.kind != "sign sighting" || decision.reason.find("waits for a direction") != std::string::npos;
  }));
}

TEST(SignLandmarksPlugin, NonsenseIsLeftAlone) {
  const SimulatedLog log(drive(1));
  auto observations = signsOf(log);
  for (auto& observation : observations) {
    auto* seen = dynamic_cast<CObservationDoorSigns*>(observation.get());
    if (!seen) continue;
    for (auto& sign : seen->signs) {
      sign.ray = Eigen::Vector3d(std::nan(""), 0, 1);
    }
    seen->signs.push_back({});
    seen->signs.back().ray = Eigen::Vector3d(0, -1, 0);  // straight up
    seen->signs.back().texts = {{"UP", 1}};
  }
  EXPECT_TRUE(Mapped(log, observations).signs.empty());
}

TEST(SignPayload, ComesBackFromBytes) {
  map::PayloadRegistry registry;
  SignPayload::addTo(registry);
  auto written = std::make_shared<SignPayload>();
  written = written->with({"213", {"OFFICE", "ROOM"}, 0.9}, "a")->with({"218", {}, 0.8}, "b")->repeated();
  std::stringstream bytes;
  written->write(bytes);
  const auto read = registry.read("door_sign", bytes.str());
  const auto& back = dynamic_cast<const SignPayload&>(*read);
  EXPECT_EQ(back.numbers, written->numbers);
  EXPECT_EQ(back.words, written->words);
  EXPECT_EQ(back.seen_by, written->seen_by);
  EXPECT_TRUE(back.is_repeated);
}

}  // namespace
}  // namespace omnimapper::plugins::sign_landmarks_plugin_test
