#include <omnimapper/base/Error.h>
#include <omnimapper/grid/GridWalk.h>
#include <omnimapper/matching/ScanWithNormals.h>
#include <omnimapper/matching/WallCrossings.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace omnimapper::matching {

using mrpt::math::TPose2D;

namespace {

// The walls of a map: the cells in which enough scans saw points of a line, with the directions of these lines.
class Walls {
 public:
  Walls(const std::vector<MapScan>& scans, const WallCrossingOptions& options);

  struct Wall {
    Eigen::Vector2d normals = Eigen::Vector2d::Zero();  // sum of unit normals, angles doubled
    std::size_t last_seen = kNobody, last_passed = kNobody;
    int seen = 0, passed = 0;  // number of scans
  };
  bool isSolid(const Wall& wall) const {
    return wall.seen >= options_.min_scans && wall.passed <= options_.max_passed * (wall.seen + wall.passed);
  }
  std::size_t solid() const {
    return static_cast<std::size_t>(
        std::count_if(walls_.begin(), walls_.end(), [this](const Wall& wall) { return isSolid(wall); }));
  }
  /// Calls use(wall) for the walls that a line passes through until `short_of` [m] before its end, as long as `use`
  /// returns true.
  template <class Use>
  void forEachCrossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double short_of, const Use& use) {
    const double length = (to - from).norm();
    const Eigen::Vector2d direction = (to - from) / length, end = from + direction * (length - short_of);
    // Angles are doubled, so that a direction and its opposite are the same.
    const Eigen::Vector2d doubled(direction.x() * direction.x() - direction.y() * direction.y(),
                                  2 * direction.x() * direction.y());
    const double least = std::cos(2 * options_.max_incidence);
    grid::walkInside(inCells(from), inCells(end), width_, height_, [&](int x, int y) {
      if (x < 0 || y < 0 || x >= width_ || y >= height_) return true;
      const std::uint32_t index = index_[static_cast<std::size_t>(y) * width_ + x];
      if (index == 0) return true;
      Wall& wall = walls_[index - 1];
      return doubled.dot(wall.normals) <= least * wall.normals.norm() || use(wall);
    });
  }

 private:
  static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  Eigen::Vector2d inCells(const Eigen::Vector2d& place) const { return (place - low_) / options_.cell; }
  void add(std::size_t number, const TPose2D& map_from_sensor, const ScanWithNormals& lines);

  WallCrossingOptions options_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<std::uint32_t> index_;  // number of the cell's wall, from 1; 0: none
  std::vector<Wall> walls_;
};

Eigen::Vector2d moved(const TPose2D& pose, const Eigen::Vector2f& point) {
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  return {pose.x + c * point.x() - s * point.y(), pose.y + s * point.x() + c * point.y()};
}

Walls::Walls(const std::vector<MapScan>& scans, const WallCrossingOptions& options) : options_(options) {
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  low_ = -high;
  for (const auto& scan : scans) {
    for (const auto& point : scan.scan.hits) {
      const auto place = moved(scan.map_from_sensor, point);
      low_ = low_.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  }
  if (!(low_.x() <= high.x())) return;
  const Eigen::Vector2d size = ((high - low_) / options.cell).array() + 1;
  if (!(size.prod() <= static_cast<double>(options.max_cells))) {
    throw base::Error(base::ExitCode::out_of_range, "A grid of walls has more than " +
                                                        std::to_string(options.max_cells) +
                                                        " cells: make the cells larger or the map smaller");
  }
  width_ = static_cast<int>(size.x());
  height_ = static_cast<int>(size.y());
  index_.resize(static_cast<std::size_t>(width_) * height_);
  for (std::size_t i = 0; i < scans.size(); ++i) add(i, scans[i].map_from_sensor, fitLines(scans[i].scan.hits));
}

void Walls::add(std::size_t number, const TPose2D& map_from_sensor, const ScanWithNormals& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines.normals[i].squaredNorm() < 0.5F) continue;
    const Eigen::Vector2d cell = inCells(moved(map_from_sensor, lines.points[i]));
    const int x = static_cast<int>(std::floor(cell.x())), y = static_cast<int>(std::floor(cell.y()));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
    std::uint32_t& index = index_[static_cast<std::size_t>(y) * width_ + x];
    if (index == 0) {
      walls_.emplace_back();
      index = static_cast<std::uint32_t>(walls_.size());
    }
    Wall& wall = walls_[index - 1];
    const double angle = 2 * (std::atan2(lines.normals[i].y(), lines.normals[i].x()) + map_from_sensor.phi);
    wall.normals += Eigen::Vector2d(std::cos(angle), std::sin(angle));
    wall.seen += wall.last_seen != number;
    wall.last_seen = number;
  }
}

}  // namespace

WallCrossings crossedWalls(const std::vector<MapScan>& scans, const WallCrossingOptions& options,
                           const std::vector<TrackStep>& track) {
  std::vector<MapScan> finite;
  for (const auto& scan : scans) finite.push_back({scan.map_from_sensor, grid::finitePart(scan.scan)});
  Walls walls(finite, options);
  // Calls use(scan, from, to) for each beam that is long enough.
  const auto forEachBeam = [&](const auto& use) {
    for (std::size_t i = 0; i < finite.size(); ++i) {
      const auto from = moved(finite[i].map_from_sensor, {0, 0});
      for (const auto& point : finite[i].scan.hits) {
        const auto to = moved(finite[i].map_from_sensor, point);
        if ((to - from).norm() > options.min_distance) use(i, from, to);
      }
    }
  };
  forEachBeam([&](std::size_t scan, const auto& from, const auto& to) {
    walls.forEachCrossed(from, to, options.min_distance, [&](Walls::Wall& wall) {
      wall.passed += wall.last_passed != scan;
      wall.last_passed = scan;
      return true;
    });
  });
  WallCrossings result{walls.solid(), std::vector<CrossedWalls>(finite.size()), {}};
  forEachBeam([&](std::size_t scan, const auto& from, const auto& to) {
    ++result.scans[scan].beams;
    walls.forEachCrossed(from, to, options.min_distance, [&](const Walls::Wall& wall) {
      const bool crossed = walls.isSolid(wall);
      result.scans[scan].crossed += crossed;
      return !crossed;
    });
  });
  for (const auto& step : track) {
    bool crosses = false;
    if (step.from.allFinite() && step.to.allFinite() && step.from != step.to) {
      walls.forEachCrossed(step.from, step.to, 0, [&](const Walls::Wall& wall) {
        crosses = walls.isSolid(wall);
        return !crosses;
      });
    }
    result.steps.push_back(crosses);
  }
  return result;
}

}  // namespace omnimapper::matching
