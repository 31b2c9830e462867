#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/matching/CorrelativeSearch.h>
#include <omnimapper/testing/SimulatedLog.h>

#include <cmath>

namespace omnimapper::matching::correlative_search_test {
namespace {

using mrpt::math::TPose2D;
using testing::FloorPlan;
using Points = std::vector<Eigen::Vector2f>;

constexpr double kDegree = 3.14159265358979323846 / 180;

// The points of a laser scan, by default all around.
Points seen(const FloorPlan& plan, const TPose2D& pose, double aperture = 360, double max_range = 12) {
  Points points;
  for (double beam = -aperture / 2; beam < aperture / 2; beam += 1) {
    const double angle = beam * kDegree;
    const double range =
        plan.distanceToWall({pose.x, pose.y}, {std::cos(pose.phi + angle), std::sin(pose.phi + angle)});
    if (range < max_range) points.emplace_back(range * std::cos(angle), range * std::sin(angle));
  }
  return points;
}

Points moved(const Points& points, const TPose2D& pose) {
  Points result;
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  for (const auto& p : points) result.emplace_back(pose.x + c * p.x() - s * p.y(), pose.y + s * p.x() + c * p.y());
  return result;
}

grid::LikelihoodPyramid mapSeenFrom(const FloorPlan& plan, const std::vector<TPose2D>& poses) {
  Points map;
  for (const auto& pose : poses) {
    const auto scan = moved(seen(plan, pose), pose);
    map.insert(map.end(), scan.begin(), scan.end());
  }
  return grid::LikelihoodPyramid(map);
}

// The best pose of the lattice, by trying all of them.
SearchResult bruteForce(const grid::LikelihoodPyramid& map, const Points& scan, const SearchWindow& window) {
  const double step = yawStep(scan, map.cell());
  const int nx = static_cast<int>(window.half_x / map.cell() + 1e-9),
            ny = static_cast<int>(window.half_y / map.cell() + 1e-9),
            nyaw = static_cast<int>(window.half_yaw / step + 1e-9);
  SearchResult best;
  for (int k = -nyaw; k <= nyaw; ++k) {
    for (int j = -ny; j <= ny; ++j) {
      for (int i = -nx; i <= nx; ++i) {
        const TPose2D pose(window.centre.x + i * map.cell(), window.centre.y + j * map.cell(),
                           window.centre.phi + k * step);
        const double score = map.score(scan, pose);
        if (score > best.score) best = {pose, score, 0};
      }
    }
  }
  return best;
}

void expectNear(const TPose2D& pose, const TPose2D& truth, double distance = 0.1, double angle = 1.5 * kDegree) {
  EXPECT_LT(std::hypot(pose.x - truth.x, pose.y - truth.y), distance) << pose << " is not " << truth;
  EXPECT_LT(std::abs(std::remainder(pose.phi - truth.phi, 360 * kDegree)), angle) << pose << " is not " << truth;
}

TEST(CorrelativeSearch, FindsWhatTryingEveryPoseFinds) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    testing::Dice dice(seed);
    Points world, scan;
    for (int i = 0; i < 40; ++i) world.emplace_back(dice.uniform(-3, 3), dice.uniform(-2, 2));
    // Half of the scan comes from the world, the other half is random.
    for (int i = 0; i < 12; ++i) scan.push_back(world[i]);
    for (int i = 0; i < 12; ++i) scan.emplace_back(dice.uniform(-4, 4), dice.uniform(-4, 4));
    const grid::LikelihoodPyramid map(world);
    const SearchWindow window{{dice.uniform(-0.3, 0.3), dice.uniform(-0.3, 0.3), dice.uniform(-0.3, 0.3)},
                              dice.uniform(0.3, 1),
                              dice.uniform(0.3, 1),
                              dice.uniform(0.1, 0.5)};
    SearchOptions options;
    options.min_score = 0;
    const auto results = search(map, scan, window, options);
    ASSERT_FALSE(results.empty());
    EXPECT_NEAR(results[0].score, bruteForce(map, scan, window).score, 1e-9);
    EXPECT_NEAR(results[0].score, map.score(scan, results[0].map_from_scan), 0.02)
        << "but for rounding at cells' sides";
  }
}

TEST(CorrelativeSearch, TheNextResultsAreTheBestOfThoseDistinctFromTheOnesBefore) {
  testing::Dice dice(5);
  Points world;
  for (int i = 0; i < 60; ++i) world.emplace_back(dice.uniform(-2, 2), dice.uniform(-2, 2));
  const Points scan(world.begin(), world.begin() + 10);
  const grid::LikelihoodPyramid map(world);
  const SearchWindow window{{0.1, 0.2, 0}, 0.8, 0.8, 0};
  SearchOptions options;
  options.min_score = options.min_share_of_best = 0;
  options.max_results = 4;
  const auto results = search(map, scan, window, options);
  ASSERT_EQ(results.size(), 4u);
  for (std::size_t rank = 0; rank < results.size(); ++rank) {
    double best = 0;
    for (int j = -16; j <= 16; ++j) {
      for (int i = -16; i <= 16; ++i) {
        const TPose2D pose(0.1 + i * 0.05, 0.2 + j * 0.05, 0);
        bool distinct = true;
        for (std::size_t k = 0; k < rank; ++k) {
          const auto& other = results[k].map_from_scan;
          distinct = distinct && std::hypot(pose.x - other.x, pose.y - other.y) > options.min_distance + 1e-9;
        }
        if (distinct) best = std::max(best, map.score(scan, pose));
      }
    }
    EXPECT_NEAR(results[rank].score, best, 0.03) << "rank " << rank;
  }
}

TEST(CorrelativeSearch, RecoversKnownPosesInTheRing) {
  const auto plan = FloorPlan::ring();
  for (const TPose2D place : {TPose2D(0, 0, 0), TPose2D(8.4, 3, 95 * kDegree), TPose2D(-2, 9, -3.1)}) {
    const auto map = mapSeenFrom(plan, {place, place + TPose2D(0.5, 0, 0.1), place + TPose2D(1, 0.1, 0)});
    for (const TPose2D offset : {TPose2D(1.3, -0.4, 0.4), TPose2D(-0.7, 0.3, -0.3), TPose2D(0.02, 0.03, 0.01)}) {
      const TPose2D truth = place + TPose2D(0.4, 0.1, 0.05);
      const SearchWindow window{{truth.x + offset.x, truth.y + offset.y, truth.phi + offset.phi}, 2, 2, 30 * kDegree};
      const auto results = search(map, seen(plan, truth, 180), window);
      ASSERT_FALSE(results.empty());
      expectNear(results[0].map_from_scan, truth);
      EXPECT_GT(results[0].score, 0.7);
    }
  }
}

TEST(CorrelativeSearch, RecoversPosesInTheWholeRingWithoutAGuess) {
  const auto plan = FloorPlan::ring();
  const auto map = mapSeenFrom(plan, {{-8, 0, 0},
                                      {-4, 0, 0},
                                      {0, 0, 0},
                                      {4, 0, 0},
                                      {8, 0, 0},
                                      {8.4, 3, 0},
                                      {8.4, 6, 0},
                                      {8.4, 9, 0},
                                      {4, 9, 0},
                                      {0, 9, 0},
                                      {-4, 9, 0},
                                      {-8.4, 9, 0},
                                      {-8.4, 6, 0},
                                      {-8.4, 3, 0}});
  for (const TPose2D truth : {TPose2D(-5.2, 0.3, 0.4), TPose2D(8.6, 5.1, -2), TPose2D(2.2, 8.7, 3.1)}) {
    const auto results = search(map, seen(plan, truth), SearchWindow::everywhere(map, 0));
    ASSERT_FALSE(results.empty());
    expectNear(results[0].map_from_scan, truth);
  }
}

TEST(CorrelativeSearch, ASymmetricRoomHasTwoAnswers) {
  FloorPlan room;
  room.addPolygon({{-3, -2}, {3, -2}, {3, 2}, {-3, 2}});
  const auto map = mapSeenFrom(room, {{0, 0, 0}, {1, 0.5, 0}, {-1, 0.5, 0}});
  const TPose2D truth(1.2, 0.4, 0.3), twin(-1.2, -0.4, 0.3 + 180 * kDegree);
  SearchOptions options;
  options.min_share_of_best = 0.9;
  const auto results = search(map, seen(room, truth), SearchWindow::everywhere(map, 0), options);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_NEAR(results[1].score, results[0].score, 0.1);
  const bool first_is_truth = results[0].map_from_scan.x > 0;
  expectNear(results[first_is_truth ? 0 : 1].map_from_scan, truth);
  expectNear(results[first_is_truth ? 1 : 0].map_from_scan, twin);
}

TEST(CorrelativeSearch, OfSeveralMapsTheOneThatFitsAnswers) {
  const auto plan = FloorPlan::ring();
  const auto here = mapSeenFrom(plan, {{0, 0, 0}, {1, 0, 0}}),
             there = mapSeenFrom(plan, {{8.4, 3, 1.5}, {8.4, 4, 1.5}});
  const auto scan = seen(plan, {8.5, 3.5, 1.4}, 180);
  const SearchWindow wide{{4, 2, 0.7}, 6, 6, 1};
  const auto together = search({{&here, wide}, {&there, wide}}, scan), alone = search(there, scan, wide);
  ASSERT_FALSE(together.empty());
  EXPECT_EQ(together[0].area, 1u);
  EXPECT_EQ(together[0].map_from_scan, alone.at(0).map_from_scan);
  EXPECT_EQ(together[0].score, alone[0].score);
  SearchOptions better;
  better.min_score = together[0].score + 0.01;
  EXPECT_TRUE(search({{&here, wide}, {&there, wide}}, scan, better).empty()) << "no pose reaches the smallest score";
}

TEST(CorrelativeSearch, AWindowOfNoSizeIsItsCentre) {
  const auto plan = FloorPlan::box();
  const auto map = mapSeenFrom(plan, {{0, 0, 0}});
  const TPose2D centre(0.013, -0.021, 0.003);
  const auto scan = seen(plan, {0, 0, 0});
  const auto results = search(map, scan, {centre, 0, 0, 0});
  ASSERT_EQ(results.size(), 1u);
  expectNear(results[0].map_from_scan, centre, 1e-12, 1e-12);
  EXPECT_NEAR(results[0].score, map.score(scan, centre), 0.01);
}

TEST(CorrelativeSearch, WithoutPointsInScanOrMapThereIsNoAnswer) {
  const auto plan = FloorPlan::box();
  const auto map = mapSeenFrom(plan, {{0, 0, 0}});
  const SearchWindow window{{0, 0, 0}, 2, 2, 1};
  EXPECT_TRUE(search(map, {}, window).empty());
  EXPECT_TRUE(search(map, {{NAN, 1}, {1, INFINITY}}, window).empty());
  EXPECT_TRUE(search(grid::LikelihoodPyramid(Points()), seen(plan, {0, 0, 0}), window).empty());
  EXPECT_TRUE(search(std::vector<SearchArea>(), seen(plan, {0, 0, 0})).empty());
  SearchOptions none;
  none.max_results = 0;
  EXPECT_TRUE(search(map, seen(plan, {0, 0, 0}), window, none).empty());
  EXPECT_TRUE(search(map, seen(plan, {0, 0, 0}), {{1000, 1e12, 0}, 2, 2, 1}).empty()) << "out of the map's reach";
}

TEST(CorrelativeSearch, OnePointFitsWhereverTheMapHasOne) {
  const grid::LikelihoodPyramid map({{1, 0}});
  SearchOptions options;
  options.max_results = 1;
  const auto results = search(map, {{2, 0}}, {{-0.8, 0.3, 0}, 1, 1, 0}, options);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_NEAR(results[0].score, 1, 1e-9);
  EXPECT_NEAR(results[0].map_from_scan.x, -1, 0.051);
  EXPECT_NEAR(results[0].map_from_scan.y, 0, 0.051);
}

TEST(CorrelativeSearch, PointsFarBeyondAllOthersDoNotBreakTheBounds) {
  Points scan{{1, 0}, {0, 1}, {-1, 0.5}}, world = scan;
  world.emplace_back(60, 3);
  scan = moved(world, {-0.4, 0.2, 0.1});
  const grid::LikelihoodPyramid map(world);
  const auto results = search(map, scan, {{0, 0, 0}, 1, 1, 3.2});
  ASSERT_FALSE(results.empty());
  EXPECT_GT(results[0].score, 0.7);
}

TEST(CorrelativeSearch, RefusesAWindowThatIsNone) {
  const grid::LikelihoodPyramid map({{1, 0}});
  const Points scan{{1, 0}};
  EXPECT_THROW(search(map, scan, {{NAN, 0, 0}, 1, 1, 1}), base::Error);
  EXPECT_THROW(search(map, scan, {{0, 0, 0}, -1, 1, 1}), base::Error);
  EXPECT_THROW(search(map, scan, {{0, 0, 0}, 1, INFINITY, 1}), base::Error);
  EXPECT_THROW(search(map, scan, {{0, 0, 0}, 1, 1, NAN}), base::Error);
}

TEST(CorrelativeSearch, ThinnedPointsAreAsFarApartAsAsked) {
  const Points points{{0, 0}, {0.02F, 0}, {0.06F, 0}, {0.11F, 0}, {0.3F, 0}};
  EXPECT_EQ(thinned(points, 0.1), (Points{{0, 0}, {0.11F, 0}, {0.3F, 0}}));
  EXPECT_EQ(thinned(points, 0), points);
}

}  // namespace
}  // namespace omnimapper::matching::correlative_search_test
