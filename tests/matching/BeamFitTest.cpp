#include <gtest/gtest.h>
#include <omnimapper/matching/BeamFit.h>

#include <cmath>

namespace omnimapper::matching::beam_fit_test {
namespace {

// Beams to all sides from a point in a room of 6 m x 4 m around the origin.
grid::BeamScan scanFrom(double x, double y) {
  grid::BeamScan scan;
  for (int i = 0; i < 360; ++i) {
    const double angle = M_PI * i / 180, c = std::cos(angle), s = std::sin(angle);
    const double to_x = c == 0 ? 1e9 : ((c > 0 ? 3 : -3) - x) / c, to_y = s == 0 ? 1e9 : ((s > 0 ? 2 : -2) - y) / s;
    const double range = std::min(to_x, to_y);
    scan.hits.emplace_back(static_cast<float>(range * c), static_cast<float>(range * s));
  }
  return scan;
}

TEST(BeamFit, ContradictsWhereBeamsEndInFreeSpaceAndNotInTheUnknown) {
  const auto seen = scanFrom(0, 0);
  const grid::HitMissGrid map({{{0, 0, 0}, &seen}});
  const auto here = bestFit(map, scanFrom(1, 0.5), {1, 0.5, 0}, 0.1, 0.05);
  EXPECT_GT(here.log_likelihood, -0.8);
  EXPECT_LT(here.contradicting, 0.05);
  const auto aside = bestFit(map, scanFrom(1, 0.5), {-1, -0.5, 0}, 0.1, 0.05);
  EXPECT_GT(aside.contradicting, 0.3) << "walls are 2 m from where they were";
  const auto outside = bestFit(map, scanFrom(0, 0), {100, 0, 0}, 0.1, 0.05);
  EXPECT_EQ(outside.contradicting, 0) << "nothing is known there";
  EXPECT_NEAR(outside.log_likelihood, std::log(0.3), 1e-6);
  const auto nothing = bestFit(map, {}, {0, 0, 0}, 0.1, 0.05);
  EXPECT_EQ(nothing.contradicting, 0);
  EXPECT_EQ(nothing.log_likelihood, 0);
}

}  // namespace
}  // namespace omnimapper::matching::beam_fit_test
