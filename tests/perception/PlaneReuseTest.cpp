// Tests that the extractors of a chain find the planes of an image once.
#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/perception/ObjectExtractor.h>

#include "../camera/RangeScans.h"
#include "TableScene.h"

namespace omnimapper::perception::plane_reuse_test {
namespace {

using mrpt::obs::CObservation;
using Observations = std::vector<CObservation::Ptr>;

/// Scan from a height of 1.4 m of a table with a block on it.
const mrpt::obs::CObservation3DRangeScan& tableScan() {
  static const auto scan = [] {
    rooms::TableScene table;
    table.addBlock({1, 0, 0.8}, {0.1, 0.15, 0.2});
    const auto view = rooms::render(table.scene);
    auto made = camera::scans::rangeScan(
        [&](int x, int y) { return double{view.depth[static_cast<std::size_t>(640 * y + x)]}; }, 640, 480);
    made.cameraParams.setIntrinsicParamsFromValues(525, 525, 319.5, 239.5);
    made.sensorPose = mrpt::poses::CPose3D(0, 0, 1.4, 0, 35 * M_PI / 180, 0);
    return made;
  }();
  return scan;
}

std::string bytesOf(const CObservation& observation) {
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << observation;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

/// What a chain of extractors makes of the scan.
Observations chain(const std::vector<const Extractor*>& extractors) {
  Blackboard board;
  Observations all;
  for (const auto* extractor : extractors) {
    for (auto& made : extractor->extractUsing(tableScan(), board)) all.push_back(std::move(made));
  }
  return all;
}

std::vector<std::string> labelsOf(const Observations& observations) {
  std::vector<std::string> labels;
  for (const auto& one : observations) labels.push_back(one->sensorLabel);
  return labels;
}

using Labels = std::vector<std::string>;

TEST(PlaneReuse, ObjectsStandOnThePlanesThatWereFoundBefore) {
  const PlaneExtractor planes({}, {});
  const ObjectExtractor objects({});
  const auto made = chain({&planes, &objects});
  ASSERT_EQ(labelsOf(made), (Labels{"kinect.planes", "kinect.objects"}));
  const auto alone = objects.extract(tableScan());
  ASSERT_FALSE(alone.objects->objects.empty());
  EXPECT_TRUE(bytesOf(*made[0]) == bytesOf(*alone.planes));
  EXPECT_TRUE(bytesOf(*made[1]) == bytesOf(*alone.objects));
}

TEST(PlaneReuse, TheOrderOfTheChainDoesNotMatter) {
  const PlaneExtractor planes({}, {});
  const ObjectExtractor objects({});
  const auto one = chain({&planes, &objects}), other = chain({&objects, &planes});
  ASSERT_EQ(labelsOf(other), (Labels{"kinect.planes", "kinect.objects"}));
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_TRUE(bytesOf(*one[i]) == bytesOf(*other[i])) << i;
}

TEST(PlaneReuse, PlanesOfOtherOptionsAreUsedOnlyIfTheIniSaysSo) {
  PlaneOptions few;
  few.min_pixels = 5000;
  const PlaneExtractor planes(few, {});
  ObjectExtractor::Options options;
  EXPECT_EQ(labelsOf(chain({&planes, std::make_unique<ObjectExtractor>(options).get()})),
            (Labels{"kinect.planes", "kinect.planes", "kinect.objects"}));
  options.reuse.reuse = PlaneReuseOptions::Reuse::any_options;
  const ObjectExtractor any(options);
  EXPECT_EQ(labelsOf(chain({&planes, &any})), (Labels{"kinect.planes", "kinect.objects"}));
  EXPECT_EQ(labelsOf(chain({&any})), (Labels{"kinect.planes", "kinect.objects"})) << "none were found before";
}

TEST(PlaneReuse, EachOptionCounts) {
  const auto& table = PlaneOptions::table();
  for (std::size_t i = 0; i < table.specs().size(); ++i) {
    PlaneSettings changed;
    // Within the bounds of every option, and the default of none.
    ASSERT_EQ(table.set(changed.planes, i, "1"), nullptr) << table.specs()[i].key;
    EXPECT_FALSE(changed == PlaneSettings()) << table.specs()[i].key;
  }
  PlaneSettings outlined, compared;
  outlined.outlines.tolerance = 2;
  compared.comparison.comparison = &kSimilarNormals;
  EXPECT_FALSE(outlined == PlaneSettings());
  EXPECT_FALSE(compared == PlaneSettings());
  EXPECT_TRUE(PlaneSettings() == PlaneSettings());
}

}  // namespace
}  // namespace omnimapper::perception::plane_reuse_test
