#include <gtest/gtest.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/testing/ShapedRun.h>

#include "object_landmarks/ObjectCarriers.h"

namespace omnimapper::plugins::object_carriers_test {
namespace {

using namespace shaped_run;

// The table of this map is 0:2, its top at 0.7 m; the floor is 0:3.
TEST(ObjectCarriers, AreBeneathTheMiddleOfTheBase) {
  const auto run = shapedRun();
  const auto view = run.view();
  const ObjectCarriers carriers(ObjectIndex("objects"), view);
  const auto under = [&](double x, double y, double bottom) {
    map::Box box;
    box.size = {0.1, 0.1, 0.2};
    box.middle = {x, y, bottom + 0.1};
    return carriers.under({0, 99}, box);
  };
  EXPECT_EQ(under(0.3, -0.2, 0.71), (base::LandmarkId{0, 2}));
  EXPECT_EQ(under(0.3, -0.2, 0.66), (base::LandmarkId{0, 2}));
  EXPECT_EQ(under(0.3, -0.2, 0.8), std::nullopt) << "above it";
  EXPECT_EQ(under(0.8, 0, 0.7), (base::LandmarkId{0, 2})) << "in the corner that was not seen";
  EXPECT_EQ(under(1.8, 0.8, 0.7), std::nullopt) << "beside the table";
  EXPECT_EQ(under(0.8, 0, 0.01), (base::LandmarkId{0, 3}));
  EXPECT_EQ(under(9, 9, 0), std::nullopt) << "beyond the floor";
}

TEST(ObjectCarriers, ADeletedTableCarriesNothing) {
  auto run = shapedRun();
  map::Corrections corrections;
  corrections.deleted.emplace_back();
  corrections.deleted.back().place.id = {0, 2};
  run.map.layers.set(std::move(corrections));
  const auto view = run.view();
  const ObjectCarriers carriers(ObjectIndex("objects"), view);
  map::Box box;
  box.size = {0.1, 0.1, 0.2};
  box.middle = {0.3, -0.2, 0.81};
  EXPECT_EQ(carriers.under({0, 99}, box), std::nullopt);
  EXPECT_FALSE(carriers.bear(box));
}

TEST(ObjectCarriers, ATableBearsWhatNoImageShowsOnIt) {
  const auto run = shapedRun();
  const auto view = run.view();
  const ObjectCarriers carriers(ObjectIndex("objects"), view);
  const auto bear = [&](double x, double y, double bottom) {
    map::Box box;
    box.size = {0.1, 0.1, 0.2};
    box.middle = {x, y, bottom + 0.1};
    return carriers.bear(box);
  };
  EXPECT_TRUE(bear(0.3, -0.2, 0.71));
  EXPECT_FALSE(bear(0.3, -0.2, 0.8)) << "above it";
  EXPECT_FALSE(bear(1.4, 0.8, 0.7)) << "beside it";
  EXPECT_FALSE(bear(0.3, -0.2, 0.01)) << "on the floor";
}

// A leg of the table of 0:2, which ends at its top, and a lamp beside the table, which does not.
TEST(ObjectCarriers, KnowLegs) {
  const auto run = shapedRun();
  const auto view = run.view();
  const ObjectCarriers carriers(ObjectIndex("objects"), view);
  const auto heldUp = [&](double x, double y, double top, double height) {
    map::Box box;
    box.size = {0.05, 0.05, height};
    box.middle = {x, y, top - 0.5 * height};
    return carriers.heldUpBy(box);
  };
  EXPECT_EQ(heldUp(0.1, -0.8, 0.68, 0.68), (base::LandmarkId{0, 2}));
  EXPECT_EQ(heldUp(0.95, 0, 0.68, 0.68), (base::LandmarkId{0, 2})) << "where the top was not seen";
  EXPECT_EQ(heldUp(0.1, -0.8, 0.85, 0.85), std::nullopt) << "it ends elsewhere";
  EXPECT_EQ(heldUp(0.1, -0.8, 0.72, 0.05), std::nullopt) << "it lies on the table";
  EXPECT_EQ(heldUp(2.5, 1, 0.68, 0.68), std::nullopt) << "far from the table";
}

}  // namespace
}  // namespace omnimapper::plugins::object_carriers_test
