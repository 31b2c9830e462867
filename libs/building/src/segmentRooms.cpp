#include <omnimapper/building/Segmentation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "Candidates.h"
#include "Outline.h"
#include "Regions.h"

namespace omnimapper::building {

namespace {

double confidenceOf(double score) {
  return 1 / (1 + std::exp(-score));
}

/// Makes rooms and doors of regions.
class RoomMaker {
 public:
  RoomMaker(const grid::GridMap& grid, const FreeSpace& space, const Pieces& pieces, const std::vector<Cut>& cuts,
            Regions& regions, const SegmentationOptions& options)
      : grid_(grid), space_(space), pieces_(pieces), cuts_(cuts), regions_(regions) {
    for (int piece = 1; piece < static_cast<int>(pieces.pieces.size()); ++piece) {
      const int region = regions.regionOf(piece);
      if (regions.region(region).area >= options.least_area) rooms_.emplace(region, Room());
    }
  }

  Segmentation make() {
    colourCells();
    measureRooms();
    addDoors();
    Segmentation result;
    result.room_of_cell = cellsOfGrid();
    for (auto& [region, room] : rooms_) result.storey.rooms.push_back(std::move(room));
    std::sort(result.storey.rooms.begin(), result.storey.rooms.end(),
              [](const Room& a, const Room& b) { return a.id < b.id; });
    result.storey.doors = std::move(doors_);
    result.storey.next_room = static_cast<int>(result.storey.rooms.size()) + 1;
    result.storey.next_door = static_cast<int>(result.storey.doors.size()) + 1;
    return result;
  }

 private:
  /// Writes the region of a room into its cells, and gives the cells of the cuts to the region beside them.
  void colourCells() {
    std::vector<int> region_of(pieces_.pieces.size(), 0);
    for (int piece = 1; piece < static_cast<int>(region_of.size()); ++piece)
      if (const int region = regions_.regionOf(piece); rooms_.count(region) > 0) region_of[piece] = region;
    region_of_cell_ = cv::Mat::zeros(space_.free.size(), CV_32S);
    std::vector<cv::Point> on_cuts;
    for (int y = 0; y < space_.free.rows; ++y) {
      const int* number = pieces_.number.ptr<int>(y);
      int* region = region_of_cell_.ptr<int>(y);
      for (int x = 0; x < space_.free.cols; ++x) {
        region[x] = region_of[number[x]];
        if (number[x] == 0 && space_.free.at<std::uint8_t>(y, x) != 0) on_cuts.emplace_back(x, y);
      }
    }
    for (bool is_new = true; is_new;) {
      is_new = false;
      std::vector<std::pair<cv::Point, int>> found;
      for (const cv::Point& at : on_cuts)
        if (const int region = neighbourOf(at); region_of_cell_.at<int>(at) == 0 && region != 0)
          found.emplace_back(at, region);
      for (const auto& [at, region] : found) region_of_cell_.at<int>(at) = region;
      is_new = !found.empty();
    }
  }
  int neighbourOf(const cv::Point& at) const {
    for (const cv::Point offset : {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)})
      if (const int region = region_of_cell_.at<int>(at + offset); region != 0) return region;
    return 0;
  }

  void measureRooms() {
    struct Extent {
      int min_x = std::numeric_limits<int>::max(), min_y = min_x, max_x = -1, max_y = -1, cells = 0;
    };
    std::vector<Extent> extents(pieces_.pieces.size());  // by region
    for (int y = 0; y < space_.free.rows; ++y) {
      const int* region = region_of_cell_.ptr<int>(y);
      for (int x = 0; x < space_.free.cols; ++x) {
        if (region[x] == 0) continue;
        Extent& extent = extents[region[x]];
        ++extent.cells;
        extent.min_x = std::min(extent.min_x, x);
        extent.max_x = std::max(extent.max_x, x);
        extent.min_y = std::min(extent.min_y, y);
        extent.max_y = y;
      }
    }
    for (auto& [region, room] : rooms_) {
      const Extent& extent = extents[region];
      const cv::Rect box(cv::Point(extent.min_x, extent.min_y), cv::Point(extent.max_x + 1, extent.max_y + 1));
      room.area = extent.cells * space_.cell * space_.cell;
      room.openness = regions_.region(region).openness();
      outline(space_, grid_.map_from_grid, region_of_cell_(box) == region, box.tl(), room);
    }
    std::vector<Room*> order;
    for (auto& [region, room] : rooms_) order.push_back(&room);
    std::stable_sort(order.begin(), order.end(), [](const Room* a, const Room* b) {
      return std::make_pair(-a->centre.y(), a->centre.x()) < std::make_pair(-b->centre.y(), b->centre.x());
    });
    for (std::size_t i = 0; i < order.size(); ++i) order[i]->id = static_cast<int>(i) + 1;
  }

  void addDoors() {
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      for (const Border& border : regions_.borders()[i]) {
        const auto left = rooms_.find(border.left), right = rooms_.find(border.right);
        if (left == rooms_.end() || right == rooms_.end()) continue;
        doors_.push_back(doorOf(cuts_[i], border, left->second.id, right->second.id));
      }
    }
    keepWidestOfEach();
    std::stable_sort(doors_.begin(), doors_.end(), [](const Door& a, const Door& b) {
      const Eigen::Vector2d p = geometry::middle(a.opening), q = geometry::middle(b.opening);
      return std::make_pair(-p.y(), p.x()) < std::make_pair(-q.y(), q.x());
    });
    std::map<int, Room*> by_id;
    for (auto& [region, room] : rooms_) {
      by_id[room.id] = &room;
      room.confidence = 1;
    }
    int next = 1;
    for (Door& door : doors_) {
      door.id = next++;
      for (const int side : {0, 1}) {
        Room& room = *by_id[door.rooms[side]];
        room.neighbours.push_back(door.rooms[1 - side]);
        room.confidence = std::min(room.confidence, door.confidence);
      }
    }
    for (auto& [region, room] : rooms_) {
      std::sort(room.neighbours.begin(), room.neighbours.end());
      room.neighbours.erase(std::unique(room.neighbours.begin(), room.neighbours.end()), room.neighbours.end());
      room.confidence *= 1 - 0.5 * room.openness;
    }
  }
  /// Several cuts at one place make one door: that of the widest.
  void keepWidestOfEach() {
    constexpr double kClose = 0.5;  // [m]
    const auto isSame = [](const Door& a, const Door& b) {
      const geometry::Segment2 &p = a.opening, &q = b.opening;
      return a.rooms == b.rooms && std::min({geometry::distance(p, q.from), geometry::distance(p, q.to),
                                             geometry::distance(p, geometry::middle(q)), geometry::distance(q, p.from),
                                             geometry::distance(q, p.to)}) < kClose;
    };
    std::stable_sort(doors_.begin(), doors_.end(), [](const Door& a, const Door& b) { return a.width > b.width; });
    std::vector<Door> kept;
    for (Door& door : doors_)
      if (std::none_of(kept.begin(), kept.end(), [&](const Door& other) { return isSame(door, other); }))
        kept.push_back(std::move(door));
    doors_ = std::move(kept);
  }

  Door doorOf(const Cut& cut, const Border& border, int left, int right) const {
    const auto inMap = [&](const cv::Point2d& point) { return grid_.map_from_grid * space_.inGrid(point); };
    Door door;
    door.confidence = confidenceOf(border.score);
    const cv::Point2d along = cut.direction();
    door.opening = {inMap(cut.from + along * border.from), inMap(cut.from + along * border.to)};
    door.width = border.width;
    door.rooms = {std::min(left, right), std::max(left, right)};
    door.evidence = border.evidence;
    return door;
  }

  std::vector<std::int32_t> cellsOfGrid() const {
    std::vector<std::int32_t> cells(grid_.cells.size(), 0);
    std::vector<std::int32_t> id_of(pieces_.pieces.size(), 0);
    for (const auto& [region, room] : rooms_) id_of[region] = room.id;
    const std::vector<int> columns_of = workingCells(grid_.columns, space_.factor);
    std::size_t i = 0;
    for (int row = 0; row < grid_.rows; ++row) {
      const int* region = region_of_cell_.ptr<int>(row / space_.factor + FreeSpace::kMargin);
      for (int column = 0; column < grid_.columns; ++column, ++i) cells[i] = id_of[region[columns_of[column]]];
    }
    return cells;
  }

  const grid::GridMap& grid_;
  const FreeSpace& space_;
  const Pieces& pieces_;
  const std::vector<Cut>& cuts_;
  Regions& regions_;
  std::map<int, Room> rooms_;  // by region
  cv::Mat region_of_cell_;     // CV_32S
  std::vector<Door> doors_;
};

}  // namespace

Segmentation segmentRooms(const grid::GridMap& grid, const SegmentationOptions& options) {
  const FreeSpace space = freeSpaceOf(grid, options);
  std::vector<Cut> cuts = candidateCuts(space, options);
  const Pieces pieces = cutIntoPieces(space, cuts);
  lookAround(space, pieces, cuts);
  Regions regions(space, pieces, cuts, options);
  return RoomMaker(grid, space, pieces, cuts, regions, options).make();
}

}  // namespace omnimapper::building
