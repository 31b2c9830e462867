#pragma once

#include <omnimapper/grid/GridMap.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "RoomScores.h"

/// The plans with true rooms that the bench of rooms reads.
namespace omnimapper::bench {

/// A picture with its lowest row first, as grids have it.
inline cv::Mat readPicture(const std::filesystem::path& file, int how) {
  cv::Mat picture = cv::imread(file.string(), how);
  if (picture.empty()) throw std::runtime_error(file.string() + " is missing");
  cv::flip(picture, picture, 0);
  return picture;
}

inline cv::Mat readGrey(const std::filesystem::path& file) {
  const cv::Mat picture = readPicture(file, cv::IMREAD_UNCHANGED);
  cv::Mat grey;
  if (picture.channels() == 1) return picture;
  if (picture.channels() == 2) cv::extractChannel(picture, grey, 0);
  if (picture.channels() > 2)
    cv::cvtColor(picture, grey, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

/// The grid of a picture: levels of at least `free` are free, those below `occupied` are occupied.
inline grid::GridMap gridOf(const cv::Mat& grey, int free, int occupied) {
  grid::GridMap grid;
  grid.columns = grey.cols;
  grid.rows = grey.rows;
  grid.resolution = 0.05;
  for (const std::uint8_t level : cv::Mat_<std::uint8_t>(grey))
    grid.cells.push_back(level >= free      ? grid::GridCell::free
                         : level < occupied ? grid::GridCell::occupied
                                            : grid::GridCell::unknown);
  return grid;
}

inline std::vector<char> freeCells(const grid::GridMap& grid) {
  std::vector<char> is_free;
  for (const auto cell : grid.cells) is_free.push_back(cell == grid::GridCell::free ? 1 : 0);
  return is_free;
}

/// A plan of the folder ipa: true rooms are areas of at least 1 m^2 that black lines separate. The open cubicles of one
/// plan are counted apart: their cells belong to no room.
struct IpaPlan {
  static constexpr int kFree = 250;
  static constexpr double kLeastRoom = 1, kLargestCubicle = 10;  // [m^2]

  IpaPlan(const std::filesystem::path& folder, const std::string& plan) : name(plan) {
    const cv::Mat picture = readGrey(folder / (plan + "_gt_segmentation.png"));
    cv::Mat areas, boxes, middles;
    cv::connectedComponentsWithStats(picture >= kFree, areas, boxes, middles, 4, CV_32S);
    const double square = 0.05 * 0.05;
    for (const int area : cv::Mat_<int>(areas)) {
      const double size = boxes.at<int>(area, cv::CC_STAT_AREA) * square;
      const bool is_cubicle = plan == "lab_a_scan" && size < kLargestCubicle && size >= kLeastRoom && area != 0;
      truth.push_back(area != 0 && size >= kLeastRoom && !is_cubicle ? area : 0);
      cubicles.push_back(is_cubicle ? area : 0);
    }
  }

  std::string name;
  CellNumbers truth, cubicles;
};

/// A map of the folder rose2: true rooms have a colour each.
struct RosePlan {
  static constexpr int kFree = 230, kOccupied = 80;

  RosePlan(const std::filesystem::path& folder, const std::string& plan)
      : name(plan), grid(gridOf(readGrey(folder / "input" / (plan + ".png")), kFree, kOccupied)) {
    const cv::Mat picture = readPicture(folder / "truth" / (plan + ".png"), cv::IMREAD_COLOR);
    for (const cv::Vec3b& colour : cv::Mat_<cv::Vec3b>(picture))
      truth.push_back(colour[0] | colour[1] << 8 | colour[2] << 16);
  }

  std::string name;
  grid::GridMap grid;
  CellNumbers truth;
};

/// Sets the numbers of rooms with fewer cells than `least`, of those that count, to 0.
inline void dropSmall(CellNumbers& rooms, const std::vector<char>& counts, double least) {
  std::map<int, double> sizes;
  for (std::size_t i = 0; i < rooms.size(); ++i) sizes[rooms[i]] += counts[i];
  for (auto& room : rooms)
    if (sizes[room] < least) room = 0;
}

}  // namespace omnimapper::bench
