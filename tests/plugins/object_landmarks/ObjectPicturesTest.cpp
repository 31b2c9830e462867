#include <gtest/gtest.h>

#include "TableWorld.h"
#include "object_landmarks/ObjectPictures.h"

namespace omnimapper::plugins::object_pictures_test {
namespace {

using namespace table_world;

TEST(ObjectPictures, ShowTheObjectAloneAndNoneWhoStandsBesideIt) {
  TableWorld world;
  Thing person{{0.3, 1.3, 1}, {0.3, 0.2, 2}};
  person.is_object = false;
  world.things = {onTable(0, 1.2, {0.2, 0.2, 0.2}), person};
  const auto [scan, objects] = world.seen({}, 0);
  ASSERT_EQ(objects->objects.size(), 1U);
  // The picture is black where a depth is that of the box, white elsewhere.
  scan->hasIntensityImage = true;
  scan->cameraParamsIntensity = scan->cameraParams;
  scan->intensityImage.resize(world.width, world.height, mrpt::img::CH_RGB);
  const auto bodies = world.all();
  const geometry::Se3 camera = geometry::fromMrpt(world.base_from_camera) * geometry::sensorFromOptical();
  int pixels = 0;
  for (int y = 0; y < world.height; ++y) {
    for (int x = 0; x < world.width; ++x) {
      const Vector3d ray((x - world.pinhole.cx) / world.pinhole.fx, (y - world.pinhole.cy) / world.pinhole.fy, 1);
      const bool is_box = world.castRay(camera.translation, camera.rotation * ray, 0, bodies).thing == 0;
      pixels += is_box;
      auto* pixel = scan->intensityImage.ptr<std::uint8_t>(static_cast<unsigned>(x), static_cast<unsigned>(y));
      for (int channel = 0; channel < 3; ++channel) pixel[channel] = is_box ? 0 : 255;
    }
  }
  const camera::RgbdView view(*scan);
  const auto pictures = picturesOf(*objects, view);
  ASSERT_EQ(pictures.size(), 1U);
  ASSERT_TRUE(pictures.front());
  EXPECT_NEAR(pictures.front()->pixels, pixels, 0.06 * pixels);
  const auto& rgb = pictures.front()->photograph->rgb;
  const auto black = std::count(rgb.begin(), rgb.end(), 0), white = std::count(rgb.begin(), rgb.end(), 255);
  EXPECT_GT(static_cast<double>(black), 0.9 * 3 * pixels);
  EXPECT_LT(static_cast<double>(white), 0.08 * static_cast<double>(rgb.size())) << "the table and the person";
}

TEST(ObjectPictures, NeedColours) {
  TableWorld world;
  world.things = {onTable(0, 1.2, {0.2, 0.2, 0.2})};
  const auto [scan, objects] = world.seen({}, 0);
  const camera::RgbdView view(*scan);
  const auto pictures = picturesOf(*objects, view);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_FALSE(pictures.front());
}

}  // namespace
}  // namespace omnimapper::plugins::object_pictures_test
