// rawlogs/atrium.ini: a camera that passes two tables twice sees all that stands on them.
#include <gtest/gtest.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/testing/Fixtures.h>

#include <map>
#include <set>

namespace atrium_test {
namespace {

using namespace omnimapper;

TEST(Atrium, everyObjectIsSeenOnBothPassesWithManyPixels) {
  base::Config config = base::Config::fromFile(omnimapper::testing::sourceFile("rawlogs/atrium.ini"));
  config.set("simulation.sensors=kinect");
  config.set("kinect.rate_hz=1");
  config.set("kinect.colour=false");
  const sim::Simulation simulation(config);
  EXPECT_LT(simulation.duration(), 90);
  ASSERT_EQ(simulation.world().objects.size(), 12u);
  std::set<std::string> shapes;
  for (const auto& object : simulation.world().objects) shapes.insert(object.shape);
  EXPECT_EQ(shapes.size(), 12u) << "they are unlike";
  const sim::Sensor& camera = *simulation.sensors().front();
  std::map<std::string, int> first, second;  // number of images of each pass that show an object with 300 pixels
  for (int k = 0; k < camera.count(); ++k) {
    const double time = camera.timeOf(k);
    if (simulation.mapFromBase().at(time)->translation.y() > 4) continue;  // in the corridors behind the atrium
    for (const auto& view : camera.measure(k).objects) {
      const auto& object = simulation.world().objects[static_cast<std::size_t>(view.object)];
      if (view.pixels >= 300) ++(time < simulation.duration() / 2 ? first : second)[object.name];
    }
  }
  for (const auto& object : simulation.world().objects) {
    EXPECT_GE(first[object.name], 3) << object.name;
    EXPECT_GE(second[object.name], 3) << object.name;
  }
}

}  // namespace
}  // namespace atrium_test
