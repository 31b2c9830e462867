// Whole logs with odd content: unusable observations are left out and counted, the others are mapped as well as ever.
// With stamps that run backwards or are repeated the exit code is 0, with values that are not finite it is that of a
// damaged log.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <limits>

#include "../MapFolder.h"
#include "../Rawlogs.h"

namespace {

using namespace runs;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using omnimapper::testing::ScratchFolder;
using omnimapper::testing::SimulatedLogOptions;
using rawlogs::Observations;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class OddObservations : public ::testing::Test {
 protected:
  static SimulatedLogOptions box() {
    SimulatedLogOptions options;
    options.place = SimulatedLogOptions::Place::box;
    return options;
  }
  /// The i-th observation of this class, laser or odometry.
  template <class Class>
  Class& nth(std::size_t i) {
    for (const auto& observation : observations_) {
      auto* found = dynamic_cast<Class*>(observation.get());
      if (found && i-- == 0) return *found;
    }
    throw std::out_of_range("the log is shorter");
  }
  CObservation2DRangeScan& scan(std::size_t i) { return nth<CObservation2DRangeScan>(i); }
  CObservationOdometry& odometry(std::size_t i) { return nth<CObservationOdometry>(i); }

  /// Maps the observations. Expects the exit code, the words on standard error, and a trajectory that is close to the
  /// truth and has the stamps `expected`.
  void expectMap(const std::vector<omnimapper::base::Stamp>& expected, const Texts& words = {},
                 ExitCode code = ExitCode::ok) {
    writeFile(scratch_ / "odd.rawlog", rawlogs::bytesOf(observations_).text);
    const auto ended = map({scratch_ / "odd.rawlog"}, folder_);
    ASSERT_TRUE(endedWith(code, ended, words));
    EXPECT_EQ(ended.err.empty(), words.empty()) << ended.err;
    EXPECT_EQ(filesIn(folder_), allOutputs());
    EXPECT_NO_THROW(loadMap(folder_));
    const auto trajectory = loadTrajectory(folder_);
    EXPECT_EQ(stampsOf(trajectory), expected);
    EXPECT_LT(errorAgainst(log_, trajectory), 0.1);
    counts_ = loadSummary(folder_)["counts"];
  }

  ScratchFolder scratch_;
  SimulatedLog log_{box()};
  Observations observations_ = log_.observations();
  std::vector<omnimapper::base::Stamp> stamps_ = scanStamps(log_);
  std::string folder_ = scratch_ / "map";
  nlohmann::json counts_;
};

TEST_F(OddObservations, RangesThatAreNoNumbersAreNoPoints) {
  const double odd[] = {kNaN, kInfinity, -kInfinity, -3, 0, 1e30};
  for (std::size_t i = 0; i < stamps_.size(); i += 3) {
    for (std::size_t beam = 0; beam < 60; ++beam) scan(i).setScanRange(beam, static_cast<float>(odd[beam % 6]));
  }
  for (std::size_t beam = 0; beam < 181; ++beam) scan(50).setScanRange(beam, std::numeric_limits<float>::quiet_NaN());
  expectMap(stamps_);
}

TEST_F(OddObservations, EmptyScansHaveTheirPoseToo) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{20}, std::size_t{21}, stamps_.size() - 1}) {
    scan(i).resizeScan(0);
  }
  scan(30).resizeScan(1);
  expectMap(stamps_);
}

TEST_F(OddObservations, OdometryThatIsNoNumberIsLeftOutAndCounted) {
  odometry(40).odometry.x(kNaN);
  odometry(80).odometry.y(kInfinity);
  odometry(81).odometry.phi(kNaN);
  expectMap(stamps_, {"warning: 3 observations", "not finite"}, ExitCode::damaged_input);
  EXPECT_EQ(counts_["unusable"], 3);
}

TEST_F(OddObservations, SensorPosesThatAreNoNumbersAreLeftOutAndCounted) {
  scan(10).sensorPose.x(kNaN);
  scan(60).sensorPose.z(kInfinity);
  stamps_.erase(stamps_.begin() + 60);
  stamps_.erase(stamps_.begin() + 10);
  expectMap(stamps_, {"warning: 2 observations"}, ExitCode::damaged_input);
  EXPECT_EQ(counts_["unusable"], 2);
}

TEST_F(OddObservations, ObservationsWithoutStampAreLeftOutAndCounted) {
  for (const std::size_t i : {10, 11, 70}) scan(i).timestamp = omnimapper::base::Stamp();
  odometry(30).timestamp = omnimapper::base::Stamp();
  for (const std::size_t i : {70, 11, 10}) stamps_.erase(stamps_.begin() + static_cast<std::ptrdiff_t>(i));
  expectMap(stamps_, {"warning: 4 observations", "without a stamp"});
  EXPECT_EQ(counts_["no_stamp"], 4);
}

TEST_F(OddObservations, RepeatedStampsAreLeftOutAndCounted) {
  scan(21).timestamp = scan(20).timestamp;
  scan(22).timestamp = scan(20).timestamp;
  stamps_.erase(stamps_.begin() + 21, stamps_.begin() + 23);
  expectMap(stamps_, {"warning: 2 observations", "with the stamp of the one before"});
  EXPECT_EQ(counts_["repeated_stamp"], 2);
}

TEST_F(OddObservations, StampsThatRunBackwardsWithinTheWindowAreSortedIn) {
  // Every scan comes a quarter of a second late, so that it comes after later odometry.
  const auto arrival = [](const auto& observation) {
    const double delay = observation->sensorLabel == "laser" ? 0.25 : 0;
    return observation->timestamp + omnimapper::base::durationFromSeconds(delay);
  };
  std::stable_sort(observations_.begin(), observations_.end(),
                   [&](const auto& a, const auto& b) { return arrival(a) < arrival(b); });
  expectMap(stamps_);
}

TEST_F(OddObservations, AScanFarBehindGetsItsPlaceAndOdometryThatLeapsBackIsRefused) {
  // A scan comes three seconds late, and a reading of the odometry has a stamp that is two seconds too early.
  const auto late = std::find_if(observations_.begin() + 200, observations_.end(),
                                 [](const auto& o) { return o->sensorLabel == "laser"; });
  std::rotate(late, late + 1, late + 100);
  odometry(100).timestamp -= omnimapper::base::durationFromSeconds(2);
  expectMap(stamps_, {"back in time"});
  EXPECT_EQ(counts_["late"], 1);
  EXPECT_EQ(counts_["unusable"], 1);
}

TEST_F(OddObservations, OneStampFarAheadDoesNoHarm) {
  const auto stamp = scan(40).timestamp;
  scan(40).timestamp += std::chrono::hours(24 * 365);
  stamps_.erase(std::find(stamps_.begin(), stamps_.end(), stamp));
  writeFile(scratch_ / "odd.rawlog", rawlogs::bytesOf(observations_).text);
  EXPECT_TRUE(endedWith(ExitCode::ok, map({scratch_ / "odd.rawlog"}, folder_)));
  auto trajectory = loadTrajectory(folder_);
  if (trajectory.size() > stamps_.size()) trajectory.pop_back();  // the scan with that stamp may come last
  EXPECT_EQ(stampsOf(trajectory), stamps_);
  EXPECT_LT(errorAgainst(log_, trajectory), 0.1);
}

}  // namespace
