#include <gtest/gtest.h>
#include <omnimapper/sim/Drive.h>
#include <omnimapper/sim_world/WorldIni.h>

#include "VisibleMoves.h"

namespace visible_moves_test {
namespace {

using namespace omnimapper;

// The robot drives from the kitchen through the hall to the study; a box goes from the kitchen to the study.
std::vector<std::string> warningsWhenCarriedAt(const std::string& time, double duration = 1000) {
  const auto config = base::Config::fromText(
      "[world]\nrooms = kitchen, hall, study\ndoors = d1, d2\nobjects = parcel\n"
      "[kitchen]\nclass = room\nrectangle_m = 0 0 4 3\n[hall]\nclass = room\nrectangle_m = 4.2 0 8.2 3\n"
      "[study]\nclass = room\nrectangle_m = 8.4 0 12 3\n"
      "[d1]\nclass = passage\nrooms = kitchen hall\nx_m = 4.1\ny_m = 1.5\n"
      "[d2]\nclass = passage\nrooms = hall study\nx_m = 8.3\ny_m = 1.5\n"
      "[parcel]\nclass = box\nx_m = 0.5\ny_m = 2.5\nmoves = " +
          time + " 11 2.5 0\n[robot]\nmode = waypoints\nwaypoints = 2 1.5, 10 1.5\n",
      "w.ini");
  const sim::World world = sim::readWorld(config);
  return sim::visibleMoves(world, sim::planDrive(config, world), duration);
}

TEST(VisibleMoves, areThoseInTheRoomWhereTheRobotIs) {
  // 8 m take 17 s: it is in the hall from about 5 to 13 s.
  for (const auto& [time, room] :
       {std::pair("2", "'kitchen'"), std::pair("15", "'study'"), std::pair("60", "'study'")}) {
    const auto warnings = warningsWhenCarriedAt(time);
    ASSERT_EQ(warnings.size(), 1u) << time;
    for (const char* part : {time, room, "parcel", "in 'hall'"})
      EXPECT_NE(warnings[0].find(part), std::string::npos) << part << " in " << warnings[0];
  }
  EXPECT_TRUE(warningsWhenCarriedAt("9").empty());
}

TEST(VisibleMoves, areNotThoseAfterTheEndOfTheRun) {
  EXPECT_TRUE(warningsWhenCarriedAt("15", 14).empty());
}

}  // namespace
}  // namespace visible_moves_test
