// How much of a simulated road is found, and how much else is taken for it: the bars of doc/results/perception.md.
#include <gtest/gtest.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/testing/Fixtures.h>

#include "../../bench/RoadAgreement.h"

namespace omnimapper::road_test {
namespace {

TEST(Road, OfASimulatedSlopeIsFoundAndHardlyAnythingElse) {
  auto config = base::Config::fromFile(testing::sourceFile("rawlogs/road.ini"));
  config.set("stereo.labels=true");
  const sim::Simulation simulation(config);
  const bench::RoadAgreement seen(simulation, "stereo", 12, {}, [] { return 0.; });
  const auto ground = seen.ground(), others = seen.others(), kerbs = seen.kerbs();
  EXPECT_GT(ground.all, 500000);
  EXPECT_GT(ground.accepted, 0.9 * ground.all);
  EXPECT_LT(others.accepted, 0.02 * others.all);
  // A kerb is too low for the noise: of these nearly half is told from the ground, no more.
  EXPECT_LT(kerbs.accepted, 0.65 * kerbs.all);
}

}  // namespace
}  // namespace omnimapper::road_test
