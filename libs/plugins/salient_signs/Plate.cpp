#include "Plate.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace omnimapper::signs {

namespace {

constexpr int kSide = 64;             // [px] largest side of the cutting
constexpr int kLeastSide = 6;         // [px] smallest side of the cutting
constexpr int kRim = 2;               // [px] width of the cutting's rim
constexpr double kLeastContrast = 6;  // grey levels by which a plate differs from its surroundings
constexpr double kOtsuShare = 0.7;    // of Otsu's threshold, which lies between wall and text of a sign
constexpr int kLeastPixels = 8;       // smallest number of a plate's pixels within the box

// The box with its surroundings, scaled down.
struct Cutting {
  cv::Mat pixels;
  cv::Point2f from;  // [px] its upper left corner in the whole picture
  float scale;       // of the cutting relative to the picture
};

std::optional<Cutting> cutOut(const cv::Mat& pixels, const cv::Rect2f& box, double surroundings) {
  const float longer = std::max(box.width, box.height), shorter = std::min(box.width, box.height);
  const auto margin = static_cast<float>(surroundings) * (0.6f * longer + 0.4f * shorter);
  const int left = std::max(0, cvRound(box.x - margin)), top = std::max(0, cvRound(box.y - margin)),
            right = std::min(pixels.cols, cvRound(box.x + box.width + margin)),
            bottom = std::min(pixels.rows, cvRound(box.y + box.height + margin));
  if (right - left < kLeastSide || bottom - top < kLeastSide) return std::nullopt;
  const cv::Mat part = pixels(cv::Rect(left, top, right - left, bottom - top));
  Cutting cutting{part, cv::Point2f(static_cast<float>(left), static_cast<float>(top)),
                  std::min(1.0f, static_cast<float>(kSide) / static_cast<float>(std::max(part.cols, part.rows)))};
  if (cutting.scale < 1) {
    const cv::Mat whole = part;
    cv::resize(whole, cutting.pixels, {}, cutting.scale, cutting.scale, cv::INTER_AREA);
  }
  if (std::min(cutting.pixels.cols, cutting.pixels.rows) < kLeastSide) return std::nullopt;
  return cutting;
}

std::uint8_t medianOfRim(const cv::Mat& channel) {
  std::vector<std::uint8_t> rim;
  for (int row = 0; row < channel.rows; ++row) {
    const auto* values = channel.ptr<std::uint8_t>(row);
    const bool whole = row < kRim || row >= channel.rows - kRim;
    for (int column = 0; column < channel.cols; ++column) {
      if (whole || column < kRim || column >= channel.cols - kRim) rim.push_back(values[column]);
    }
  }
  std::nth_element(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(rim.size() / 2), rim.end());
  return rim[rim.size() / 2];
}

// The difference of each pixel from the rim, in the channel with the largest one.
cv::Mat differenceFromRim(const cv::Mat& pixels) {
  std::vector<cv::Mat> channels;
  cv::split(pixels, channels);
  cv::Mat difference;
  for (const cv::Mat& channel : channels) {
    cv::Mat here;
    cv::absdiff(channel, cv::Scalar(medianOfRim(channel)), here);
    difference = difference.empty() ? here : cv::Mat(cv::max(difference, here));
  }
  return difference;
}

// The component that covers most of the box.
cv::Mat componentIn(const cv::Mat& mask, const cv::Rect& box) {
  cv::Mat labels;
  const int count = cv::connectedComponents(mask, labels, 4, CV_32S);
  std::vector<int> pixels(static_cast<std::size_t>(count), 0);
  const cv::Mat within = labels(box);
  for (int row = 0; row < within.rows; ++row) {
    const auto* values = within.ptr<int>(row);
    for (int column = 0; column < within.cols; ++column) ++pixels[static_cast<std::size_t>(values[column])];
  }
  const auto best = std::max_element(pixels.begin() + 1, pixels.end());
  if (best == pixels.end() || *best < kLeastPixels) return {};
  return labels == static_cast<int>(best - pixels.begin());
}

// The outer edges, in the whole picture, of corner pixels of the cutting.
Corners inPicture(const Corners& corners, const Cutting& cutting) {
  static const Eigen::Vector2f outwards[] = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}};
  Corners result;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2f edge = corners[i] + outwards[i] + Eigen::Vector2f::Constant(0.5f);
    result[i] = edge / cutting.scale + Eigen::Vector2f(cutting.from.x - 0.5f, cutting.from.y - 0.5f);
  }
  return result;
}

}  // namespace

std::optional<Corners> findPlate(const cv::Mat& pixels, const cv::Rect2f& box, double surroundings) {
  const auto cutting = cutOut(pixels, box, surroundings);
  if (!cutting) return std::nullopt;
  const cv::Mat difference = differenceFromRim(cutting->pixels);
  cv::Mat mask;
  const double otsu = cv::threshold(difference, mask, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  if (otsu < kLeastContrast) return std::nullopt;
  cv::threshold(difference, mask, std::max(kLeastContrast, kOtsuShare * otsu), 255, cv::THRESH_BINARY);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8U));
  const float scale = cutting->scale;
  const cv::Rect whole(0, 0, mask.cols, mask.rows);
  const cv::Rect within =
      cv::Rect(cv::Point(cvRound((box.x - cutting->from.x) * scale), cvRound((box.y - cutting->from.y) * scale)),
               cv::Point(cvRound((box.x + box.width - cutting->from.x) * scale),
                         cvRound((box.y + box.height - cutting->from.y) * scale))) &
      whole;
  if (within.empty()) return std::nullopt;
  const cv::Mat component = componentIn(mask, within);
  if (component.empty()) return std::nullopt;
  std::vector<cv::Point> points;
  cv::findNonZero(component, points);
  return inPicture(outermostCorners(points), *cutting);
}

Corners outermostCorners(const std::vector<cv::Point>& points) {
  const auto most = [&](int x, int y) {
    const cv::Point at = *std::max_element(points.begin(), points.end(), [&](const cv::Point& a, const cv::Point& b) {
      return x * a.x + y * a.y < x * b.x + y * b.y;
    });
    return Eigen::Vector2f(static_cast<float>(at.x), static_cast<float>(at.y));
  };
  return {most(-1, -1), most(1, -1), most(1, 1), most(-1, 1)};
}

cv::Rect2f boundsOf(const Corners& corners) {
  Eigen::Vector2f low = corners[0], high = corners[0];
  for (const Eigen::Vector2f& corner : corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
}

double overlapOf(const cv::Rect2f& a, const cv::Rect2f& b) {
  const double both = (a & b).area(), together = a.area() + b.area() - both;
  return together > 0 ? both / together : 0;
}

}  // namespace omnimapper::signs
