#include <gtest/gtest.h>
#include <omnimapper/derived/ThingsOfMap.h>

#include <list>

namespace omnimapper::derived::things_of_map_test {

namespace {

using Eigen::Vector3d;

/// Landmarks with one flat surface each.
class Landmarks {
 public:
  void add(const std::string& label, const std::vector<Vector3d>& corners, bool moved = false) {
    map::Landmark& landmark = landmarks_.emplace_back();
    landmark.id = {0, static_cast<std::uint32_t>(landmarks_.size() + 9)};
    landmark.evidence = 5;
    ShapedLandmark shaped{&landmark, {}, moved};
    shaped.shape.label = label;
    shaped.shape.surfaces.push_back(geometry::Polygon3{corners});
    shaped.shape.normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]).normalized();
    shaped_.push_back(shaped);
    map::Place& place = places.emplace_back();
    place.id = landmark.id;
    place.kind = place.label = label;
    place.measurements = 5;
    place.seen_by = {{"camera", 5}};
    place.properties = {{"area", map::Measure{1, "m2"}}};
  }
  const std::vector<ShapedLandmark>& shaped() const { return shaped_; }

  std::vector<map::Place> places;

 private:
  std::list<map::Landmark> landmarks_;
  std::vector<ShapedLandmark> shaped_;
};

/// The top and a side of a bed of 2 by 1.6 m, 0.5 m high, a wall behind it, and a table that was carried away.
Landmarks bedroom() {
  Landmarks all;
  all.add("wall", {{-1, 1.7, 2}, {-1, 1.7, 0}, {3, 1.7, 0}, {3, 1.7, 2}});
  all.add("bed", {{0, 0, 0.5}, {2, 0, 0.5}, {2, 1.6, 0.5}, {0, 1.6, 0.5}});
  all.add("bed", {{0, 0, 0}, {2, 0, 0}, {2, 0, 0.5}, {0, 0, 0.5}});
  all.add("table", {{5, 0, 0.7}, {6, 0, 0.7}, {6, 1, 0.7}, {5, 1, 0.7}}, true);
  return all;
}

}  // namespace

TEST(ThingsOfMap, FacesOfOneBedAreOneThing) {
  const Landmarks all = bedroom();
  const auto things = thingsOf(all.shaped(), {});
  ASSERT_EQ(things.size(), 1U);
  EXPECT_EQ(things[0].faces, (std::vector<std::size_t>{1, 2}));
}

TEST(ThingsOfMap, FacesOfOneThingAreOnePlaceWithItsSize) {
  Landmarks all = bedroom();
  all.places[2].properties.push_back({"name", std::string("Ella's bed")});
  joinFaces(thingsOf(all.shaped(), {}), all.shaped(), all.places);
  ASSERT_EQ(all.places.size(), 3U);
  const map::Place& bed = all.places[1];
  EXPECT_EQ(toString(bed.id), "0:11");
  EXPECT_EQ(bed.label, "bed");
  EXPECT_EQ(bed.measurements, 10U);
  EXPECT_EQ(bed.seen_by.at("camera"), 10U);
  ASSERT_EQ(bed.extent.outlines.size(), 1U);
  EXPECT_NEAR(bed.position.x(), 1, 0.07);
  EXPECT_NEAR(bed.position.y(), 0.8, 0.07);
  std::map<std::string, std::string> texts;
  for (const auto& property : bed.properties) texts[property.name] = textOf(property);
  EXPECT_EQ(texts.at("name"), "Ella's bed");
  EXPECT_EQ(texts.at(map::kParts), "0:11, 0:12");
  EXPECT_NEAR(std::stod(texts.at("length")), 2, 0.07);
  EXPECT_NEAR(std::stod(texts.at("width")), 1.6, 0.07);
  EXPECT_EQ(texts.count("area"), 0U) << "that of one face says nothing";
}

TEST(ThingsOfMap, AThingOfOneFaceKeepsItsPlace) {
  Landmarks all;
  all.add("table", {{0, 0, 0.7}, {1, 0, 0.7}, {1, 1, 0.7}, {0, 1, 0.7}});
  joinFaces(thingsOf(all.shaped(), {}), all.shaped(), all.places);
  ASSERT_EQ(all.places.size(), 1U);
  EXPECT_EQ(all.places[0].properties.front().name, "area");
}

}  // namespace omnimapper::derived::things_of_map_test
