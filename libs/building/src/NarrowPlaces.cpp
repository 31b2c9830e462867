#include "NarrowPlaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "DisjointSets.h"

namespace omnimapper::building {

namespace {

// A saddle matters if both sides are clearly wider [m].
constexpr double kLeastDrop = 0.075, kLeastPeak = 0.3, kWidestSaddle = 1.5;
constexpr double kLargestShare = 0.9;  // of the radius of the smaller peak

/// The free cells, from the farthest from obstacles to the nearest; cells that are equally far (by an eighth of a cell)
/// are in the order of the grid.
std::vector<int> cellsByClearance(const cv::Mat& clearance) {
  constexpr float kBins = 8;
  const auto* values = clearance.ptr<float>();
  const int count = static_cast<int>(clearance.total());
  const int last = static_cast<int>(*std::max_element(values, values + count) * kBins);
  std::vector<int> begins(static_cast<std::size_t>(last) + 2, 0);
  const auto bin = [&](int i) { return last - static_cast<int>(values[i] * kBins); };
  for (int i = 0; i < count; ++i)
    if (values[i] > 0) ++begins[bin(i) + 1];
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  std::vector<int> order(begins.back());
  for (int i = 0; i < count; ++i)
    if (values[i] > 0) order[begins[bin(i)]++] = i;
  return order;
}

/// Floods the clearance from its peaks and finds where the basins of two clear peaks meet.
class Flood {
 public:
  explicit Flood(const FreeSpace& space)
      : space_(space),
        values_(space.clearance.ptr<float>()),
        basin_(space.clearance.total(), -1),
        is_border_(space.clearance.total(), 0) {
    const int width = space.clearance.cols;
    around_ = {-width - 1, -width, -width + 1, -1, 1, width - 1, width, width + 1};
  }

  std::vector<int> saddles() {
    for (const int cell : cellsByClearance(space_.clearance)) enter(cell);
    return saddles_;
  }

 private:
  void enter(int cell) {
    found_.clear();
    bool is_at_border = false;
    for (const int offset : around_) {
      const int neighbour = cell + offset;
      if (basin_[neighbour] < 0) continue;
      is_at_border |= is_border_[neighbour] != 0;
      const int basin = basins_.find(basin_[neighbour]);
      if (std::find(found_.begin(), found_.end(), basin) == found_.end()) found_.push_back(basin);
    }
    if (found_.empty()) {
      basin_[cell] = basins_.add();
      peaks_.push_back(values_[cell]);
      return;
    }
    std::sort(found_.begin(), found_.end(),
              [&](int a, int b) { return peaks_[a] != peaks_[b] ? peaks_[a] > peaks_[b] : a < b; });
    basin_[cell] = found_[0];
    for (std::size_t i = 1; i < found_.size(); ++i) {
      if (isClear(peaks_[found_[i]], values_[cell])) {
        if (is_border_[cell] == 0 && !is_at_border) saddles_.push_back(cell);
        is_border_[cell] = 1;
      } else {
        basins_.join(found_[0], found_[i]);
      }
    }
  }
  bool isClear(double peak, double saddle) const {
    const double cell = space_.cell;
    return (peak - saddle) * cell >= kLeastDrop && saddle <= kLargestShare * peak && peak * cell >= kLeastPeak &&
           saddle * cell <= kWidestSaddle;
  }

  const FreeSpace& space_;
  const float* values_;
  std::array<int, 8> around_{};
  std::vector<int> basin_;
  std::vector<char> is_border_;
  DisjointSets basins_;
  std::vector<float> peaks_;
  std::vector<int> saddles_;
  std::vector<int> found_;  // basins around a cell; kept to save allocations
};

/// The obstacle nearest to a saddle; if `opposite` is given, only on the other side of the saddle.
std::optional<cv::Point2d> nearestObstacle(const FreeSpace& space, const cv::Point& saddle, int reach,
                                           const std::optional<cv::Point2d>& opposite) {
  constexpr double kMostCosine = -0.3;
  std::optional<cv::Point2d> nearest;
  double smallest = std::numeric_limits<double>::infinity();
  for (int y = std::max(0, saddle.y - reach); y <= std::min(space.free.rows - 1, saddle.y + reach); ++y) {
    for (int x = std::max(0, saddle.x - reach); x <= std::min(space.free.cols - 1, saddle.x + reach); ++x) {
      const cv::Point2d to(x - saddle.x, y - saddle.y);
      const double distance = std::hypot(to.x, to.y);
      if (distance >= smallest || space.free.at<std::uint8_t>(y, x) != 0) continue;
      if (opposite) {
        const cv::Point2d other = *opposite - cv::Point2d(saddle);
        if (to.dot(other) >= kMostCosine * distance * cv::norm(other)) continue;
      }
      smallest = distance;
      nearest = cv::Point2d(x, y);
    }
  }
  return nearest;
}

}  // namespace

std::vector<Cut> narrowPlaces(const FreeSpace& space) {
  std::vector<Cut> cuts;
  for (const int cell : Flood(space).saddles()) {
    const cv::Point saddle(cell % space.clearance.cols, cell / space.clearance.cols);
    const int reach = static_cast<int>(1.6 * space.clearance.at<float>(saddle) + 3);
    const auto from = nearestObstacle(space, saddle, reach, std::nullopt);
    if (!from) continue;
    const auto to = nearestObstacle(space, saddle, reach, from);
    if (!to) continue;
    Cut cut;
    cut.from = *from;
    cut.to = *to;
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

}  // namespace omnimapper::building
