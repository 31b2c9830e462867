#include <gtest/gtest.h>

#include "omnimapper/map/LabelledPlaces.h"

namespace omnimapper::map::labelled_places_test {
namespace {

TEST(LabelledPlaces, ARegionOfThingsWithoutExtentLiesBetweenThem) {
  std::vector<Place> places(2);
  Labels labels;
  for (std::uint32_t i = 0; i < 2; ++i) {
    places[i].id = {0, i};
    places[i].position = {2.0 * i, 1, 0.5};
    Label label;
    label.text = "corner";
    label.landmark = places[i].id;
    labels.labels.push_back(label);
  }
  const LabelAnchors anchors{[](base::LandmarkId id) { return id; },
                             [](const Label&) { return Eigen::Vector3d(0, 0, 0); }};
  addLabels(labels, anchors, places);
  ASSERT_EQ(places.size(), 3U);
  const auto& region = places.back();
  EXPECT_EQ(region.kind, Labels::kRegion);
  const std::vector<Eigen::Vector2d> hull{{0, 1}, {2, 1}};
  EXPECT_EQ(region.extent.outlines.front(), hull);
  EXPECT_EQ(region.position.y(), 1);
  EXPECT_TRUE(region.position.x() >= 0 && region.position.x() <= 2) << region.position.x();
}

}  // namespace
}  // namespace omnimapper::map::labelled_places_test
