#include <gtest/gtest.h>
#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/testing/BoxWorld.h>

#include <random>

namespace grid_mapper_test {
namespace {

using namespace box_world;
using derived::Cell;
using derived::ScanGrid;

void expectSame(const std::optional<ScanGrid>& a, const std::optional<ScanGrid>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->columns, b->columns);
  EXPECT_EQ(a->rows, b->rows);
  EXPECT_EQ(a->resolution, b->resolution);
  EXPECT_EQ(a->min_x, b->min_x);
  EXPECT_EQ(a->min_y, b->min_y);
  EXPECT_TRUE(a->cells == b->cells);
}

/// A map that grows and is deformed at random, with two lasers on the robot, one of them upside down and facing back.
class ChangingMap {
 public:
  explicit ChangingMap(unsigned seed) : random_(seed) {}
  const map::Map& map() const { return map_; }

  void addKeyFrame() {
    const auto index = static_cast<std::uint32_t>(map_.key_frames.size());
    auto frame =
        keyFrame(index, index, CPose3D(uniform(-0.8, 1.8), uniform(-0.8, 0.8), 0, uniform(-3, 3), 0, 0), front_);
    if (uniform(0, 1) < 0.5) addBack(frame);
    map_.key_frames.insert(frame);
  }
  /// Moves one key frame by about `size` [m] and [rad].
  void move(double size) {
    auto& frame = anyFrame();
    frame.map_from_base =
        frame.map_from_base + CPose3D(uniform(-size, size), uniform(-size, size), uniform(-size, size),
                                      uniform(-size, size), 0, 0.1 * uniform(-size, size));
  }
  void moveAll(const CPose3D& by) {
    for (std::size_t i = 0; i < map_.key_frames.size(); ++i) {
      auto& frame = map_.key_frames.edit(map_.key_frames[i].id);
      frame.map_from_base = by + frame.map_from_base;
    }
  }
  /// Inserts a key frame as a late observation does.
  void addScan() { addBack(anyFrame()); }
  void removeScan() {
    auto& observations = anyFrame().observations;
    if (!observations.empty()) observations.pop_back();
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

 private:
  void addBack(map::KeyFrame& frame) {
    frame.observations.push_back(scanFrom(frame.map_from_base, back_, frame.stamp));
  }
  map::KeyFrame& anyFrame() {
    const auto count = static_cast<double>(map_.key_frames.size());
    return map_.key_frames.edit(map_.key_frames[static_cast<std::size_t>(uniform(0, count - 1e-9))].id);
  }

  std::mt19937 random_;
  CPose3D front_{0.2, 0, 0.3, 0.1, 0, 0}, back_{-0.1, 0.05, 0.4, 3.0, 0.01, M_PI};
  map::Map map_;
};

TEST(GridMapper, afterAnyMovesTheGridIsThatOfTheMapBuiltAtOnce) {
  derived::ScanGridOptions fine, coarse;
  coarse.max_cells = 7000;  // so that the resolution changes when the map is deformed
  for (unsigned seed = 1; seed <= 3; ++seed) {
    ChangingMap changing(seed);
    derived::GridMapper fine_mapper(fine), coarse_mapper(coarse);
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(step));
      changing.addKeyFrame();
      for (int i = 0; i < 3; ++i) changing.move(changing.uniform(0, 1) < 0.5 ? 0.002 : 0.5);
      if (step % 5 == 1) changing.addScan();
      if (step % 7 == 2) changing.removeScan();
      if (step % 11 == 3) changing.moveAll(CPose3D(1, -7.3, 0, 0.5, 0, 0));
      for (const auto& [mapper, options] : {std::pair{&fine_mapper, &fine}, std::pair{&coarse_mapper, &coarse}}) {
        mapper->update(changing.map());
        expectSame(mapper->scanGrid(), derived::buildScanGrid(changing.map(), *options));
      }
    }
  }
}

TEST(GridMapper, onlyKeyFramesThatMovedAreEnteredAgain) {
  auto run = boxRun();
  derived::GridMapper mapper({});
  EXPECT_TRUE(mapper.update(run.map));
  EXPECT_EQ(mapper.traced(), 3u);
  EXPECT_FALSE(mapper.update(run.map));
  EXPECT_EQ(mapper.traced(), 3u);
  run.map.key_frames.edit({0, 1}).map_from_base.x_incr(0.2);
  EXPECT_TRUE(mapper.update(run.map));
  EXPECT_EQ(mapper.traced(), 5u) << "taken out once and entered once";
  for (std::uint32_t i = 0; i < 3; ++i) run.map.key_frames.edit({0, i}).map_from_base.z_incr(1);
  EXPECT_FALSE(mapper.update(run.map)) << "the grid is seen from above";
}

TEST(GridMapper, aKeyFrameThatIsGoneLeavesNoTrace) {
  const auto run = boxRun();
  map::Map two;
  for (const std::size_t i : {0, 2}) two.key_frames.insert(run.map.key_frames[i]);
  derived::GridMapper mapper({});
  mapper.update(run.map);
  EXPECT_TRUE(mapper.update(two));
  expectSame(mapper.scanGrid(), derived::buildScanGrid(two, {}));
  EXPECT_TRUE(mapper.update({}));
  EXPECT_FALSE(mapper.scanGrid());
}

TEST(GridMapper, aPoseThatIsNoPlaceIsLeftOut) {
  auto run = boxRun();
  const auto two = [&] {
    map::Map map;
    for (const std::size_t i : {1, 2}) map.key_frames.insert(run.map.key_frames[i]);
    return map;
  }();
  for (const double far : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e15}) {
    run.map.key_frames.edit({0, 0}).map_from_base = CPose3D(far, 0, 0, 0, 0, 0);
    expectSame(derived::buildScanGrid(run.map, {}), derived::buildScanGrid(two, {}));
  }
}

}  // namespace
}  // namespace grid_mapper_test
