// Simulates some of the presets, maps them from laser and odometry, and compares the trajectory with the truth.
#include "../MapFolder.h"
#include "SimulateRun.h"

namespace {

using namespace runs;

struct Place {
  const char* ini;
  const char* duration;  // [s] of the log; 0: the whole drive
  double largest_error;  // [m]
};

class SimulatedPlaces : public ::testing::TestWithParam<Place> {};

TEST_P(SimulatedPlaces, AreMappedFromLaserAndOdometry) {
  const omnimapper::testing::ScratchFolder scratch;
  const std::string ini = GetParam().ini;
  ASSERT_TRUE(
      endedWith(ExitCode::ok, simulate({"-i", omnimapper::testing::sourceFile("rawlogs/" + ini + ".ini"), "-o",
                                        scratch / "log", "-q", "--set", "simulation.sensors=laser, odometry", "--set",
                                        std::string("simulation.duration_s=") + GetParam().duration})));
  ASSERT_TRUE(endedWith(ExitCode::ok, map({scratch / "log/" + ini + ".rawlog"}, scratch / "map")));
  const auto estimate = loadTrajectory(scratch / "map");
  const auto truth = omnimapper::eval::readTum(scratch / "log/truth.tum");
  EXPECT_GT(estimate.size(), 2900U);
  omnimapper::eval::PairingOptions pairing;
  pairing.alignment = omnimapper::eval::Alignment::yaw;
  const double error = omnimapper::eval::absoluteTrajectoryError(estimate, truth, pairing).translation.rmse;
  RecordProperty("ate_m", std::to_string(error));
  EXPECT_LT(error, GetParam().largest_error);
}

INSTANTIATE_TEST_SUITE_P(Presets, SimulatedPlaces,
                         ::testing::Values(Place{"home", "300", 0.02}, Place{"office", "0", 0.07}),
                         [](const auto& info) { return std::string(info.param.ini); });

}  // namespace
