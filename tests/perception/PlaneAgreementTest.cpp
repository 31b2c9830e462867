// The counts by which planes are judged, on images of a few pixels with results worked out by hand.
#include <gtest/gtest.h>

#include "PlaneAgreement.h"

namespace omnimapper::perception::rooms::plane_agreement_test {
namespace {

Agreement compareRows(const std::vector<std::uint16_t>& truth, const std::vector<std::uint16_t>& labels) {
  return compare({{}, truth}, labels, static_cast<int>(truth.size()), 1, 1);
}

TEST(PlaneAgreement, TheTruthAgreesWithItself) {
  const Agreement a = compareRows({1, 1, 1, 2, 2, 0}, {2, 2, 2, 1, 1, 0});
  EXPECT_EQ(a.true_planes, 2);
  EXPECT_EQ(a.found, 2);
  EXPECT_EQ(a.reported, 2);
  EXPECT_EQ(a.reported_right, 2);
  EXPECT_EQ(a.correct, 2);
  EXPECT_EQ(a.over + a.under + a.missed + a.noise, 0);
  EXPECT_EQ(a.pixelsRight(), 1);
}

TEST(PlaneAgreement, APlaneInTwoPiecesIsOverSegmented) {
  const Agreement a = compareRows({1, 1, 1, 1, 1, 1}, {1, 1, 1, 2, 2, 2});
  EXPECT_EQ(a.over, 1);
  EXPECT_EQ(a.correct + a.under + a.missed + a.noise, 0);
  EXPECT_EQ(a.found, 0);
  EXPECT_EQ(a.pixelsRight(), 0.5);
}

TEST(PlaneAgreement, ASegmentOverTwoPlanesIsUnderSegmented) {
  const Agreement a = compareRows({1, 1, 1, 2, 2, 2, 2}, {1, 1, 1, 1, 1, 1, 1});
  EXPECT_EQ(a.under, 1);
  EXPECT_EQ(a.correct + a.over + a.missed + a.noise, 0);
  EXPECT_EQ(a.reported_right, 0);
  // It is right on the larger of the two.
  EXPECT_DOUBLE_EQ(a.pixelsRight(), 4. / 7);
}

TEST(PlaneAgreement, NothingThereIsMissedAndSomethingElsewhereIsNoise) {
  const Agreement a = compareRows({1, 1, 1, 0, 0, 0}, {0, 0, 0, 1, 1, 1});
  EXPECT_EQ(a.missed, 1);
  EXPECT_EQ(a.noise, 1);
  EXPECT_EQ(a.correct + a.over + a.under, 0);
  EXPECT_EQ(a.pixelsRight(), 0);
}

TEST(PlaneAgreement, EightTenthsAreEnough) {
  const std::vector<std::uint16_t> ten(10, 1);
  const Agreement eight = compareRows(ten, {1, 1, 1, 1, 1, 1, 1, 1, 0, 0});
  EXPECT_EQ(eight.correct, 1);
  EXPECT_EQ(eight.found, 1);
  const Agreement seven = compareRows(ten, {1, 1, 1, 1, 1, 1, 1, 0, 0, 0});
  EXPECT_EQ(seven.correct, 0);
  EXPECT_EQ(seven.missed, 1);
  EXPECT_EQ(seven.noise, 1);
}

TEST(PlaneAgreement, PartsOfAFaceThatDoNotMeetAreTwoPlanesAndCountsAddUp) {
  Agreement sum = compareRows({1, 1, 0, 1, 1}, {1, 1, 0, 2, 2});
  EXPECT_EQ(sum.true_planes, 2);
  EXPECT_EQ(sum.correct, 2);
  sum += compareRows({1, 1}, {0, 0});
  EXPECT_EQ(sum.true_planes, 3);
  EXPECT_EQ(sum.missed, 1);
  EXPECT_DOUBLE_EQ(sum.pixelsRight(), 4. / 6);
}

}  // namespace
}  // namespace omnimapper::perception::rooms::plane_agreement_test
