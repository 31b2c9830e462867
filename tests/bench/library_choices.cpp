// Compares our own code with libraries that could replace it: the nearest point of a scan (nanoflann's KD-tree), the
// smallest rectangle around a footprint (OpenCV's minAreaRect), and damaged PCD files (PCL's reader, if it is
// installed). Prints the rows that doc/decisions/libraries.md shows.
//
// Example: bench-library_choices --log aces.rawlog
#include <PointIndex.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <objects/OrientedBox.h>
#include <omnimapper/source/RawlogSource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <nanoflann.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "PcdReaders.h"

namespace {

using namespace omnimapper;
using Clock = std::chrono::steady_clock;
using Points = std::vector<Eigen::Vector2f>;

constexpr float kReach = 0.5F;  // [m] largest distance of a search

double microsecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

std::vector<Points> scansOf(const std::string& log) {
  std::vector<Points> scans;
  source::RawlogSource source(log);
  while (const auto observation = source.next()) {
    const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
    if (!scan) continue;
    mrpt::maps::CSimplePointsMap map;
    map.insertObservation(*scan);
    Points points;
    for (std::size_t i = 0; i < map.size(); ++i) {
      float x, y;
      map.getPoint(i, x, y);
      points.emplace_back(x, y);
    }
    if (points.size() > 20) scans.push_back(std::move(points));
  }
  return scans;
}

// The interface by which nanoflann reads points.
struct PointTable {
  const Points& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointTable>, PointTable, 2, unsigned>;

bool isFound(const Tree& tree, const Eigen::Vector2f& point) {
  unsigned index = 0;
  float squared = 0;
  nanoflann::KNNResultSet<float, unsigned> result(1);
  result.init(&index, &squared);
  squared = kReach * kReach;  // the search radius, from which the tree search starts
  tree.findNeighbors(result, point.data(), nanoflann::SearchParams());
  return result.size() > 0 && squared < kReach * kReach;
}

// Searches the points of a scan in the scans before it, ten times with a converging pose, as our matcher does.
void compareSearches(const std::vector<Points>& scans, std::size_t in_map) {
  double build_grid = 0, build_tree = 0, ask_grid = 0, ask_likely = 0, ask_tree = 0;
  std::size_t maps = 0, asked = 0, unlike = 0;
  for (std::size_t i = in_map; i < scans.size(); i += 25) {
    matching::ScanWithNormals map;
    for (std::size_t k = i - in_map; k < i; ++k) map.points.insert(map.points.end(), scans[k].begin(), scans[k].end());
    map.normals.assign(map.points.size(), Eigen::Vector2f::Zero());
    auto begin = Clock::now();
    const matching::PointIndex grid(map);
    build_grid += microsecondsSince(begin);
    const PointTable table{map.points};
    begin = Clock::now();
    Tree tree(2, table, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    build_tree += microsecondsSince(begin);
    ++maps;
    std::vector<int> likely(scans[i].size(), matching::PointIndex::kNone), found = likely;
    std::vector<char> by_tree(scans[i].size());
    for (float off = 0.1F; off > 1e-4F; off *= 0.5F) {
      const Eigen::Vector2f shift(off, -off);
      begin = Clock::now();
      for (std::size_t j = 0; j < found.size(); ++j) {
        const Eigen::Vector2f p = scans[i][j] + shift;
        found[j] = grid.nearest(p.x(), p.y(), kReach);
      }
      ask_grid += microsecondsSince(begin);
      begin = Clock::now();
      for (std::size_t j = 0; j < likely.size(); ++j) {
        const Eigen::Vector2f p = scans[i][j] + shift;
        likely[j] = grid.nearest(p.x(), p.y(), kReach, likely[j]);
      }
      ask_likely += microsecondsSince(begin);
      begin = Clock::now();
      for (std::size_t j = 0; j < by_tree.size(); ++j) by_tree[j] = isFound(tree, scans[i][j] + shift) ? 1 : 0;
      ask_tree += microsecondsSince(begin);
      asked += found.size();
      for (std::size_t j = 0; j < found.size(); ++j)
        unlike += (found[j] == matching::PointIndex::kNone) != (by_tree[j] == 0);
    }
  }
  if (maps == 0) return;
  const auto n = static_cast<double>(maps), m = static_cast<double>(asked);
  std::printf("| %zu scans | %.1f | %.1f | %.3f | %.3f | %.3f | %zu of %zu |\n", in_map, build_grid / n, build_tree / n,
              ask_grid / m, ask_likely / m, ask_tree / m, unlike, asked);
}

// Compares rectangles around noisy footprints of rotated boxes.
void compareRectangles() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double ours = 0, theirs = 0, largest = 0, smallest = 0;
  constexpr int kBoxes = 3000;
  for (int k = 0; k < kBoxes; ++k) {
    const Eigen::Rotation2Dd turn(3 * uniform(random));
    const Eigen::Vector2d middle(5 * uniform(random), 5 * uniform(random));
    const Eigen::Array2d size(0.05 + std::abs(uniform(random)), 0.05 + 0.3 * std::abs(uniform(random)));
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 3 + k % 400; ++i) {
      const Eigen::Array2d place(uniform(random), uniform(random));
      const Eigen::Vector2d point = middle + turn * (size * place).matrix();
      points.emplace_back(point.x(), point.y(), uniform(random));
    }
    auto begin = Clock::now();
    const auto box = perception::objects::boxAlong(Eigen::Vector3d::UnitZ(), points);
    ours += microsecondsSince(begin);
    begin = Clock::now();
    std::vector<cv::Point2f> corners;
    for (const auto& p : points) corners.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    const auto rectangle = cv::minAreaRect(corners);
    theirs += microsecondsSince(begin);
    const double ratio = rectangle.size.area() / box.size.head<2>().prod() - 1;
    largest = std::max(largest, ratio);
    smallest = std::min(smallest, ratio);
  }
  std::printf(
      "\nRectangles around %d footprints: ours %.1f us, minAreaRect %.1f us; its area over ours %+.1e to %+.1e\n",
      kBoxes, ours / kBoxes, theirs / kBoxes, smallest, largest);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares our own code with libraries that could replace it.");
  std::string log;
  app.add_option("--log", log, "rawlog with a 2D laser")->required();
  CLI11_PARSE(app, argc, argv);
  const auto scans = scansOf(log);
  std::printf(
      "| map of | grid: build [us] | tree: build | grid: a point [us] | with a likely one | tree | found by one "
      "only |\n|---|---|---|---|---|---|---|\n");
  for (const std::size_t in_map : {1, 10}) compareSearches(scans, in_map);
  compareRectangles();
  bench::comparePcdReaders();
}
