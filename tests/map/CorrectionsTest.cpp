#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/map/ClosedLoops.h>
#include <omnimapper/map/Corrections.h>
#include <omnimapper/map/Map.h>

#include <cmath>
#include <limits>

namespace omnimapper::map::corrections_test {
namespace {

Place placeOf(base::LandmarkId id, const std::string& parts = "") {
  Place place;
  place.id = id;
  place.kind = place.label = "table";
  if (!parts.empty()) place.properties = {{kParts, parts}};
  return place;
}

Corrections corrected() {
  Corrections corrections;
  corrections.deleted = {{placeOf({0, 3}, "0:3, 1:9"), "anna", base::stampFromUnix(1'700'000'000)}};
  corrections.forbidden = {{{0, 8}, {1, 2}, "page", base::stampFromUnix(1'700'000'001)}};
  return corrections;
}

template <class T>
MapSection sectionOf(const T& layer) {
  return {T::kLayer, T::kLayerVersion, layer.toBytes()};
}

TEST(Corrections, AreReadAsTheyWereWritten) {
  const auto read = Corrections::fromSection(sectionOf(corrected()));
  EXPECT_EQ(read.toBytes(), corrected().toBytes());
  ASSERT_EQ(read.deleted.size(), 1U);
  EXPECT_EQ(read.deleted[0].who, "anna");
  EXPECT_EQ(landmarksOf(read.deleted[0].place), (std::vector<base::LandmarkId>{{0, 3}, {1, 9}}));
  EXPECT_EQ(read.forbidden[0].to, (base::KeyFrameId{1, 2}));
  EXPECT_EQ(read.references().key_frames.size(), 2U);
}

TEST(Corrections, DamagedOnesAreRefused) {
  MapSection cut = sectionOf(corrected());
  cut.bytes.resize(cut.bytes.size() - 1);
  EXPECT_THROW(Corrections::fromSection(cut), base::Error);
  MapSection long_one = sectionOf(corrected());
  long_one.bytes += "x";
  EXPECT_THROW(Corrections::fromSection(long_one), base::Error);
  MapSection later = sectionOf(corrected());
  later.version = 2;
  EXPECT_THROW(Corrections::fromSection(later), base::Error);
}

TEST(Corrections, ADeletedLandmarkThatWasMergedDeletesTheOneThatHasItsMeasurements) {
  Map map;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Landmark landmark;
    landmark.id = {0, i};
    if (i == 1) {
      landmark.state = Landmark::State::merged;
      landmark.merged_into = {0, 2};
    }
    map.landmarks.add(0, landmark);
  }
  EXPECT_TRUE(deletedLandmarks(map).empty());
  Corrections corrections;
  corrections.deleted = {{placeOf({0, 1}), "", {}}};
  map.layers.set(corrections);
  EXPECT_EQ(deletedLandmarks(map), (std::set<base::LandmarkId>{{0, 2}}));
}

TEST(ClosedLoops, AreReadAsTheyWereWrittenUnlessTheyAreDamaged) {
  ClosedLoops closed;
  closed.loops = {{{0, 1}, {1, 7}, {1.5, -2}, {1.25, -2}, "loop_closure", "why"}};
  const auto read = ClosedLoops::fromSection(sectionOf(closed));
  EXPECT_EQ(read.toBytes(), closed.toBytes());
  EXPECT_EQ(read.loops[0].to, (base::KeyFrameId{1, 7}));
  EXPECT_EQ(read.loops[0].from_in_map, Eigen::Vector2d(1.5, -2));
  closed.loops[0].to_in_map.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ClosedLoops::fromSection(sectionOf(closed)), base::Error);
}

}  // namespace
}  // namespace omnimapper::map::corrections_test
