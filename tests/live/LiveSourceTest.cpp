#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/live/LiveSource.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/testing/Fixtures.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>

#include "Observations.h"

namespace omnimapper::live::live_source_test {

/// A driver whose behaviour the test sets.
class ScriptedSensor : public mrpt::hwdrivers::CGenericSensor {
  DEFINE_GENERIC_SENSOR(ScriptedSensor)
 public:
  enum class Does { send, nothing, fail, throw_int, hang };

  void initialize() override {
    ++opened;
    if (cannot_open) throw std::runtime_error("nobody answers");
  }
  void doProcess() override {
    switch (does.load()) {
      case Does::send: {
        auto observation = is_camera ? mrpt::obs::CObservation::Ptr(std::make_shared<mrpt::obs::CObservationImage>(
                                           observations::image(0, m_sensorLabel)))
                                     : std::make_shared<mrpt::obs::CObservationOdometry>(observations::odometry(0));
        observation->timestamp = mrpt::Clock::now();
        observation->sensorLabel = m_sensorLabel;
        appendObservation(observation);
        break;
      }
      case Does::nothing:
        break;
      case Does::fail:
        throw std::runtime_error("the plug is out");
      case Does::throw_int:
        throw 1;
      case Does::hang:
        while (does == Does::hang) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        break;
    }
  }
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override {
    is_camera = ini.read_bool(section, "camera", false);
  }

  static std::atomic<Does> does;
  static std::atomic<bool> cannot_open;
  static std::atomic<int> opened;

 private:
  bool is_camera = false;
};

IMPLEMENTS_GENERIC_SENSOR(ScriptedSensor, omnimapper::live::live_source_test)
std::atomic<ScriptedSensor::Does> ScriptedSensor::does{Does::send};
std::atomic<bool> ScriptedSensor::cannot_open{false};
std::atomic<int> ScriptedSensor::opened{0};

namespace {

using Does = ScriptedSensor::Does;
using std::chrono::milliseconds;

const base::AtLoad kRegistered([] { ScriptedSensor::doRegister(); });

class LiveSourceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ScriptedSensor::does = Does::send;
    ScriptedSensor::cannot_open = false;
    ScriptedSensor::opened = 0;
    options.silent_after = 0.2;
    options.reopen_after = 0.4;
  }

  std::unique_ptr<LiveSource> sourceOf(const std::string& sections, const std::string& names, bool record = true) {
    const auto config = base::Config::fromText("[live]\nsensors = " + names + "\n" + sections, "robot.ini");
    options.sensors = config.section("live").read<LiveOptions>().sensors;
    return std::make_unique<LiveSource>(
        readSensors(options, config), options,
        record ? std::make_unique<Recorder>(folder.path(), "log", RecorderOptions{}) : nullptr);
  }
  std::unique_ptr<LiveSource> wheels() {
    return sourceOf("[wheels]\ndriver = ScriptedSensor\nsensorLabel = wheels\nprocess_rate = 100\n", "wheels");
  }

  // All observations that come within that time.
  static std::vector<LiveObservation> take(LiveSource& source, milliseconds time) {
    std::vector<LiveObservation> all;
    const auto end = std::chrono::steady_clock::now() + time;
    while (std::chrono::steady_clock::now() < end) {
      if (auto one = source.next(milliseconds(10))) all.push_back(*one);
    }
    return all;
  }
  static std::string takeNews(LiveSource& source, milliseconds time) {
    take(source, time);
    std::string all;
    for (const auto& sentence : source.takeNews()) all += sentence + "\n";
    return all;
  }
  // Returns when there is news that contains the words.
  static void awaitNews(LiveSource& source, const std::string& words) {
    while (takeNews(source, milliseconds(20)).find(words) == std::string::npos) continue;
  }

  testing::ScratchFolder folder;
  LiveOptions options;
};

TEST_F(LiveSourceTest, whatIsGivenIsWhatWasRecorded) {
  const auto source = wheels();
  source->open({});
  auto given = take(*source, milliseconds(300));
  source->close();
  while (const auto rest = source->next(milliseconds(0))) given.push_back(*rest);
  ASSERT_GT(given.size(), 5u);
  source::RawlogSource log(folder / "log.rawlog");
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_EQ(given[i].number, i);
    const auto recorded = log.next();
    ASSERT_TRUE(recorded) << i;
    EXPECT_EQ(recorded->timestamp, given[i].observation->timestamp);
  }
  EXPECT_FALSE(log.next());
  EXPECT_FALSE(source->hasLeftBehind());
  const auto counts = source->counts();
  EXPECT_EQ(counts.arrived, given.size());
  EXPECT_EQ(counts.given, given.size());
  EXPECT_EQ(counts.waiting, 0u);
}

TEST_F(LiveSourceTest, ofACameraTheNewestFramesAreKeptAndOfOdometryAll) {
  const auto source = sourceOf(
      "[camera]\ndriver = ScriptedSensor\nsensorLabel = eye\nprocess_rate = 100\ncamera = true\n"
      "[wheels]\ndriver = ScriptedSensor\nsensorLabel = wheels\nprocess_rate = 100\n",
      "camera, wheels");
  source->open({});
  std::this_thread::sleep_for(milliseconds(400));
  source->close();
  std::set<std::uint64_t> numbers;
  int frames = 0;
  while (const auto one = source->next(milliseconds(0))) {
    frames += one->observation->sensorLabel == "eye";
    numbers.insert(one->number);
  }
  EXPECT_EQ(frames, options.camera_queue);
  const auto dropped = source->takeDropped();
  const auto counts = source->counts();
  EXPECT_GT(counts.dropped, 5u);
  EXPECT_EQ(dropped.size(), counts.dropped);
  EXPECT_EQ(counts.arrived, counts.given + counts.dropped + counts.not_kept + counts.unusable + counts.waiting);
  for (const auto number : dropped) EXPECT_TRUE(numbers.insert(number).second) << "both given and dropped";
  EXPECT_EQ(numbers.size(), counts.arrived);
}

TEST_F(LiveSourceTest, silenceIsReportedAndTheSensorIsOpenedAgain) {
  const auto source = wheels();
  source->open({});
  take(*source, milliseconds(100));
  ScriptedSensor::does = Does::nothing;
  awaitNews(*source, "is silent");
  EXPECT_EQ(source->sensors().at(0).state, SensorMetrics::State::silent);
  awaitNews(*source, "is lost");
  ScriptedSensor::does = Does::send;
  awaitNews(*source, "is back");
  EXPECT_EQ(source->sensors().at(0).state, SensorMetrics::State::working);
  EXPECT_EQ(source->sensors().at(0).losses, 1u);
  EXPECT_GE(ScriptedSensor::opened, 2);
  // The time without data is not among the intervals that lengthen the patience.
  ScriptedSensor::does = Does::nothing;
  awaitNews(*source, "is silent");
}

TEST_F(LiveSourceTest, aDriverThatThrowsIsOpenedAgain) {
  const auto source = wheels();
  source->open({});
  ScriptedSensor::does = Does::fail;
  awaitNews(*source, "the plug is out");
  ScriptedSensor::does = Does::throw_int;  // it fails for another reason now, which is not reported again
  EXPECT_EQ(takeNews(*source, milliseconds(1000)), "");
  ScriptedSensor::does = Does::send;
  awaitNews(*source, "is back");
}

TEST_F(LiveSourceTest, aSensorThatCannotBeOpenedIsAnError) {
  ScriptedSensor::cannot_open = true;
  const auto source = wheels();
  try {
    source->open({});
    ADD_FAILURE();
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("[wheels]"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("nobody answers"), std::string::npos) << error.what();
  }
}

TEST_F(LiveSourceTest, aDriverThatHangsIsLeftBehind) {
  const auto source = wheels();
  source->open({});
  ScriptedSensor::does = Does::hang;
  take(*source, milliseconds(50));
  source->close();
  EXPECT_TRUE(source->hasLeftBehind());
  ScriptedSensor::does = Does::nothing;  // so that the driver returns
  std::this_thread::sleep_for(milliseconds(100));
}

}  // namespace
}  // namespace omnimapper::live::live_source_test
