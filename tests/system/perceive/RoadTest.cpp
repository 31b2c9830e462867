// How much of a simulated road is found, and how much of other surfaces is taken for it: the limits of
// doc/results/perception.md.
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
  const bench::RoadAgreement agreement(simulation, "stereo", 12, {}, [] { return 0.; });
  const auto ground = agreement.ground(), others = agreement.others(), sides = agreement.kerbSides(),
             tops = agreement.kerbTops();
  EXPECT_GT(ground.all, 500000);
  EXPECT_GT(ground.accepted, 0.91 * ground.all);
  EXPECT_LT(others.accepted, 0.005 * others.all);
  EXPECT_GT(sides.all, 10000);
  EXPECT_LT(sides.accepted, 0.15 * sides.all);
  EXPECT_LT(others.accepted + sides.accepted, 0.01 * (others.all + sides.all));
  // The top of a kerb is as level and as high as the pavement, but is not part of the ground.
  EXPECT_GT(tops.all, 5000);
  EXPECT_LT(others.accepted + sides.accepted + tops.accepted, 0.02 * (others.all + sides.all + tops.all));
}

}  // namespace
}  // namespace omnimapper::road_test
