#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/geometry/OpticalFrame.h>
#include <omnimapper/plugin/SessionStart.h>
#include <omnimapper/testing/MapperRun.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sign_landmarks/SignPayload.h"

// Drives past beacons whose numbers are written on signs: a camera measures the direction and the text of each.
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

/// The log, with its beacons as signs. `reported_offset`: reported - true pan and tilt [rad].
std::vector<CObservation::Ptr> signsOf(const SimulatedLog& log, const TextOf& text_of = numbered,
                                       const Eigen::Vector2d& reported_offset = Eigen::Vector2d::Zero()) {
  auto observations = log.observations();
  for (auto& observation : observations) {
    const auto seen = std::dynamic_pointer_cast<mrpt::obs::CObservationBearingRange>(observation);
    if (!seen) continue;
    auto signs = CObservationDoorSigns::Create();
    signs->timestamp = seen->timestamp;
    signs->sensorLabel = "camera.signs";
    signs->source_label = "camera";
    const auto base_from_sensor = geometry::fromMrpt(seen->sensorLocationOnRobot);
    const geometry::Se3 reported{Eigen::AngleAxisd(reported_offset[0], Eigen::Vector3d::UnitZ()) *
                                     base_from_sensor.rotation *
                                     Eigen::AngleAxisd(reported_offset[1], Eigen::Vector3d::UnitY()),
                                 base_from_sensor.translation};
    signs->sensorPose = geometry::toMrpt(reported * geometry::sensorFromOptical());
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
      EXPECT_EQ(landmark.evidence, payload.measurements());
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

// With wheels and a camera, there is no other evidence for or against the map.
TEST(SignLandmarksPlugin, NumbersThatAreMetAgainSpeakForTheMap) {
  const SimulatedLog log(drive(2)), once(drive(0.5));
  const auto verdictOf = [](const Mapped& mapped) { return mapped.engine->view().verdict; };
  const auto verdict = verdictOf(Mapped(log, signsOf(log)));
  EXPECT_EQ(verdict.answer, mapper::Verdict::Answer::consistent) << sentenceOf(verdict);
  EXPECT_TRUE(verdictOf(Mapped(once, signsOf(once))).evidence.empty());
}

// A second round in which all signs are elsewhere: their numbers have been exchanged.
TEST(SignLandmarksPlugin, NumbersThatStandElsewhereSpeakAgainstIt) {
  const SimulatedLog log(drive(2));
  auto before = signsOf(log);
  const auto after = signsOf(log, [](int number) { return numbered((number + 7) % 14); });
  std::copy(after.begin() + static_cast<std::ptrdiff_t>(after.size() / 2), after.end(),
            before.begin() + static_cast<std::ptrdiff_t>(before.size() / 2));
  const Mapped mapped(log, before);
  EXPECT_EQ(mapped.engine->view().verdict.answer, mapper::Verdict::Answer::suspicious)
      << sentenceOf(mapped.engine->view().verdict);
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

// Two doors with the same word: they are not merged, and both are in the map.
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

// A robot whose camera reports a direction two degrees to the left and two degrees above the true one.
TEST(SignLandmarksPlugin, OffsetsOfThePanTiltAreFound) {
  const SimulatedLog log(drive(2));
  constexpr double kDegree = geometry::kPi / 180;
  const Mapped mapped(log, signsOf(log, numbered, Eigen::Vector2d(2, -2) * kDegree));
  std::vector<Eigen::Vector2d> offsets;
  for (const auto& [id, record] : mapped.engine->view().graph.variables())
    if (record.kind->kind() == "pan_tilt") offsets.emplace_back(record.value);
  ASSERT_EQ(offsets.size(), 1U) << "one camera, one run";
  EXPECT_NEAR(offsets[0][0], -2 * kDegree, 0.2 * kDegree);
  EXPECT_NEAR(offsets[0][1], 2 * kDegree, 0.2 * kDegree);
  const Mapped straight(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * straight.error + 0.02);
}

// A map of a first session, and a second session whose start is unknown.
struct Continued {
  Continued(const Mapped& first, const SimulatedLog& log, const TextOf& text_of) : engine(testing::makeEngine(kIni)) {
    const auto view = first.engine->view();
    engine->sessions().continueFrom({view.map, view.graph}, mapper::startAnywhere(view.map));
    testing::run(*engine, signsOf(log, text_of));
  }
  std::unique_ptr<mapper::Engine> engine;
};

TEST(SignLandmarksPlugin, TwoDrivesThatShareTwoSignsAreAligned) {
  const SimulatedLog log(drive(1));
  const Mapped first(log, signsOf(log));
  const SimulatedLog again(drive(1, 2));
  // In the second drive, two signs are those of the first, and all others have other texts.
  const auto shared = [](int number) { return std::to_string((number == 2 || number == 3 ? 200 : 400) + number); };
  const Continued second(first, again, shared);
  const auto view = second.engine->view();
  EXPECT_TRUE(view.map.sessions.back().aligned);
  std::map<std::string, int> landmarks;
  for (const auto& [id, landmark] : view.map.landmarks)
    if (landmark.state == map::Landmark::State::active)
      ++landmarks[dynamic_cast<const SignPayload&>(*landmark.payload).title()];
  EXPECT_EQ(landmarks["202"], 1);
  EXPECT_EQ(landmarks["203"], 1);
  // Both sessions drive the same path from the same start.
  const auto& frames = view.map.key_frames;
  const auto start =
      std::find_if(frames.begin(), frames.end(), [](const auto& frame) { return frame.id.session == 1; });
  EXPECT_LT(frames.front().map_from_base.distanceTo((*start).map_from_base), 1);
}

// A poster, or a number that is misread, must not displace a session whose start is known.
TEST(SignLandmarksPlugin, ASessionWhoseStartIsKnownStaysWhereItIs) {
  const SimulatedLog log(drive(1));
  const Mapped first(log, signsOf(log));
  const auto view = first.engine->view();
  const auto engine = testing::makeEngine(kIni);
  engine->sessions().continueFrom({view.map, view.graph}, {{0, 0, 0, 0, 0, 0}, 0.5, 0.1});
  // One sign has the text of another one in the map; all others are new.
  testing::run(*engine, signsOf(SimulatedLog(drive(0.3, 2)),
                                [](int number) { return std::to_string(number == 2 ? 208 : 400 + number); }));
  const auto& frames = engine->view().map.key_frames;
  const auto start =
      std::find_if(frames.begin(), frames.end(), [](const auto& frame) { return frame.id.session == 1; });
  EXPECT_LT((*start).map_from_base.norm(), 0.5);
}

TEST(SignLandmarksPlugin, ADriveThatSharesNoSignIsNotAligned) {
  const SimulatedLog log(drive(1));
  const Mapped first(log, signsOf(log));
  const Continued second(first, SimulatedLog(drive(1, 2)), [](int number) { return std::to_string(400 + number); });
  EXPECT_FALSE(second.engine->view().map.sessions.back().aligned);
}

// The robot is set down somewhere in a map that is held.
TEST(SignLandmarksPlugin, ARobotInAMapThatIsHeldIsFoundBySigns) {
  const SimulatedLog log(drive(1));
  const Mapped first(log, signsOf(log));
  const auto held = first.engine->view();
  const SimulatedLog again(drive(1, 2));
  auto observations = signsOf(again);
  observations.erase(observations.begin(), observations.begin() + static_cast<std::ptrdiff_t>(observations.size() / 3));
  const auto engine = testing::makeEngine(kIni, {}, 1, true);
  constexpr int kFreeKeyFrames = 20;
  engine->sessions().localizeIn({held.map, held.graph}, mapper::startAnywhere(held.map), kFreeKeyFrames);
  testing::run(*engine, observations);
  const auto view = engine->view();
  const mrpt::poses::CPose3D truth_from_map(log.truthAt(held.map.key_frames.front().stamp));
  std::size_t near = 0, located = 0;
  for (const auto& estimate : view.localization) {
    if (!estimate.located()) continue;
    const mrpt::poses::CPose3D truth(again.truthAt(estimate.stamp));
    const auto pose = truth_from_map + estimate.map_from_base;
    ++located;
    near += std::hypot(pose.x() - truth.x(), pose.y() - truth.y()) < 0.75;
  }
  EXPECT_GT(located, view.localization.size() / 2);
  EXPECT_EQ(near, located);
}

// As with the doors of two storeys, or of two wings.
TEST(SignLandmarksPlugin, ANumberThatStandsOnTwoDoorsClosesNothing) {
  const SimulatedLog log(drive(2));
  const Mapped mapped(log, signsOf(log, [](int number) { return numbered(number == 5 ? 0 : number); }));
  const Mapped truly(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * truly.error + 0.02);
  EXPECT_EQ(mapped.signs.at("200").size(), 2U);
}

TEST(SignLandmarksPlugin, ASignThatIsMovedToAnotherDoorBendsNothing) {
  const SimulatedLog log(drive(2));
  auto before = signsOf(log),
       after = signsOf(log, [](int number) { return number == 0 ? "" : numbered(number == 6 ? 0 : number); });
  std::copy(after.begin() + static_cast<std::ptrdiff_t>(after.size() / 2), after.end(),
            before.begin() + static_cast<std::ptrdiff_t>(before.size() / 2));
  const Mapped mapped(log, before), truly(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * truly.error + 0.02);
  EXPECT_EQ(mapped.signs.at("200").size(), 2U) << "where it was, and where it is";
}

// One of four readings is wrong: there is one sign, with the number that was read most often.
TEST(SignLandmarksPlugin, ContradictoryTextsAtOnePlaceAreOneSign) {
  const SimulatedLog log(drive(1));
  int readings = 0;
  const auto misread = [&](int number) { return number == 2 && ++readings % 4 == 0 ? "207" : numbered(number); };
  const Mapped mapped(log, signsOf(log, misread)), truly(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * truly.error + 0.02);
  ASSERT_EQ(mapped.signs.count("202"), 1U);
  EXPECT_EQ(mapped.signs.at("202").size(), 1U);
  const auto& real = drive(1).beacons.positions;
  for (const auto& place : mapped.signs.at("207"))
    EXPECT_GT((place - real[2]).norm(), 0.5) << "what was misread stands nowhere beside it";
}

TEST(SignLandmarksPlugin, ATextThatChangesBendsNothing) {
  const SimulatedLog log(drive(2));
  auto before = signsOf(log);
  const auto after =
      signsOf(log, [](int number) { return number < 3 ? std::to_string(777 - number) : numbered(number); });
  std::copy(after.begin() + static_cast<std::ptrdiff_t>(after.size() / 2), after.end(),
            before.begin() + static_cast<std::ptrdiff_t>(before.size() / 2));
  const Mapped mapped(log, before), truly(log, signsOf(log));
  EXPECT_LT(mapped.error, 1.3 * truly.error + 0.05);
  EXPECT_EQ(mapped.signs.at("200").size(), 1U);
  EXPECT_EQ(mapped.signs.at("777").size(), 1U);
}

TEST(SignLandmarksPlugin, AMeasurementOfAnUnknownOneWaitsAndSaysSo) {
  const SimulatedLog log(drive(1));
  auto observations = signsOf(log);
  int left = 2;  // of the three directions that are needed
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
    return decision.kind != "sign measurement" || decision.reason.find("waits for a direction") != std::string::npos;
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
  EXPECT_FALSE(back.best_look);
}

TEST(SignPayload, KeepsItsLargestLook) {
  map::PayloadRegistry registry;
  SignPayload::addTo(registry);
  auto written = SignPayload().with({"213", {}, 0.9}, "a");
  map::Photograph photograph{2, 1, {1, 2, 3, 4, 5, 6}};
  written->best_look = SignLook{{0, 7}, Eigen::Vector3d::UnitY(), 900, std::make_shared<map::Photograph>(photograph)};
  EXPECT_FALSE(written->isBetter(800));
  EXPECT_TRUE(written->isBetter(1000));
  std::stringstream bytes;
  written->write(bytes);
  const auto read = registry.read("door_sign", bytes.str());
  const auto& back = dynamic_cast<const SignPayload&>(*read);
  ASSERT_TRUE(back.best_look);
  EXPECT_EQ(back.best_look->frame, written->best_look->frame);
  EXPECT_EQ(back.best_look->photograph->rgb, photograph.rgb);
  EXPECT_EQ(back.keyFrames(), std::vector<base::KeyFrameId>{written->best_look->frame});
  // A smaller look of another sign does not replace it, a larger one does.
  auto other = SignPayload().with({"213", {}, 0.9}, "a");
  other->best_look = SignLook{{0, 9}, Eigen::Vector3d::UnitX(), 100, nullptr};
  EXPECT_EQ(written->with(*other)->best_look->frame.index, 7U);
  other->best_look->area_px = 2000;
  EXPECT_EQ(written->with(*other)->best_look->frame.index, 9U);
}

TEST(SignPayload, IsReadFromMapsOfBeforeItKeptALook) {
  map::PayloadRegistry registry;
  SignPayload::addTo(registry);
  const auto written = SignPayload().with({"213", {}, 0.9}, "a");
  std::stringstream bytes;
  written->write(bytes);
  std::string old = bytes.str();
  old[0] = 1;
  old.pop_back();  // whether there is a look
  const auto read = registry.read("door_sign", old);
  EXPECT_EQ(dynamic_cast<const SignPayload&>(*read).title(), "213");
}

}  // namespace
}  // namespace omnimapper::plugins::sign_landmarks_plugin_test
