#include "LineSplitting.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "LineReader.h"

namespace omnimapper::signs {

namespace {

using Eigen::Vector2f;

constexpr float kLeastLine = 6;  // [px] smallest height of a line in the picture
// Smallest height of a line, as a share of the text's; a lower part may be the dots above a letter.
constexpr float kLeastShare = 0.2f;
constexpr float kValley = 0.6f;  // largest activity of the row between two lines, as a share of the less busy line's

// Activity of each row, or of each column: the mean change along x, less the smallest mean.
std::vector<float> activityOf(const cv::Mat& edges, int across) {
  cv::Mat mean;
  cv::reduce(edges, mean, across, cv::REDUCE_AVG, CV_32F);
  mean = mean.reshape(1, 1);
  double least = 0;
  cv::minMaxLoc(mean, &least);
  mean -= least;
  return {mean.begin<float>(), mean.end<float>()};
}

// The activity of the busiest row, if at least `line` rows are half as busy; else 0.
float busiestOf(const float* begin, const float* end, int line) {
  const float most = *std::max_element(begin, end);
  return std::count_if(begin, end, [&](float value) { return 2 * value >= most; }) >= line ? most : 0;
}

// The emptiest row between two lines that are far busier.
std::optional<int> valleyIn(const std::vector<float>& activity) {
  const int rows = static_cast<int>(activity.size());
  const int line = static_cast<int>(std::max(kLeastLine, kLeastShare * static_cast<float>(rows)));
  std::optional<int> best;
  float best_ratio = kValley;
  for (int row = line; row + line < rows; ++row) {
    const float* begin = activity.data();
    const float lesser = std::min(busiestOf(begin, begin + row, line), busiestOf(begin + row + 1, begin + rows, line));
    if (!(lesser > 0) || begin[row] / lesser >= best_ratio) continue;
    best_ratio = begin[row] / lesser;
    best = row;
  }
  return best;
}

// The part of a region between these shares of its height and width.
Corners partOf(const Corners& quad, float top, float bottom, float left, float right) {
  const auto at = [&](float x, float y) -> Vector2f {
    return (1 - y) * ((1 - x) * quad[0] + x * quad[1]) + y * ((1 - x) * quad[3] + x * quad[2]);
  };
  return {at(left, top), at(right, top), at(right, bottom), at(left, bottom)};
}

// The line without the empty parts on its left and right, except for a margin of a fifth of its height.
Corners narrowed(const cv::Mat& edges, const Corners& line) {
  constexpr float kBusy = 0.15f, kMargin = 0.2f;
  const auto activity = activityOf(edges, 0);
  const float most = *std::max_element(activity.begin(), activity.end());
  const auto is_busy = [&](float value) { return value > kBusy * most; };
  const auto first = std::find_if(activity.begin(), activity.end(), is_busy) - activity.begin();
  const auto last = activity.rend() - std::find_if(activity.rbegin(), activity.rend(), is_busy);
  const float columns = static_cast<float>(edges.cols), margin = kMargin * static_cast<float>(edges.rows);
  return partOf(line, 0, 1, std::max(0.f, (static_cast<float>(first) - margin) / columns),
                std::min(1.f, (static_cast<float>(last) + margin) / columns));
}

}  // namespace

std::vector<Corners> partsOf(const cv::Mat& picture, const Corners& text) {
  if (heightOf(text) < 2 * kLeastLine) return {};
  const cv::Mat patch = patchOf(picture, text);
  if (patch.empty()) return {};
  cv::Mat grey, edges;
  cv::cvtColor(patch, grey, cv::COLOR_BGR2GRAY);
  cv::Sobel(grey, edges, CV_32F, 1, 0, 1);
  edges = cv::abs(edges);
  const auto valley = valleyIn(activityOf(edges, 1));
  if (!valley) return {};
  const float share = (static_cast<float>(*valley) + 0.5f) / static_cast<float>(edges.rows);
  return {narrowed(edges.rowRange(0, *valley), partOf(text, 0, share, 0, 1)),
          narrowed(edges.rowRange(*valley + 1, edges.rows), partOf(text, share, 1, 0, 1))};
}

}  // namespace omnimapper::signs
