#include "TextDetector.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace omnimapper::signs {

namespace {

using Eigen::Vector2f;

// Means and deviations of PaddleOCR's DB detectors, channels in the order blue, green, red.
constexpr float kMeans[] = {0.485f, 0.456f, 0.406f}, kDeviations[] = {0.229f, 0.224f, 0.225f};
constexpr float kInCore = 0.3f;      // smallest probability of a pixel in the core of a line
constexpr double kLeastScore = 0.5;  // smallest mean probability of a core
constexpr float kThinnestCore = 3;   // [px] of the network's output, smallest side of a core
// The network finds only the core of a line. Its sides are moved outwards by this factor times its area over its
// perimeter, as follows from the network's training.
constexpr float kGrowth = 1.6f;

// The network's input, with the picture at its upper left and black around it.
net::Tensor inputOf(const cv::Mat& picture) {
  constexpr int kPlane = TextDetector::kRows * TextDetector::kColumns;
  net::Tensor input{{1, 3, TextDetector::kRows, TextDetector::kColumns}, std::vector<float>(3 * kPlane)};
  for (int channel = 0; channel < 3; ++channel) {
    float* plane = input.values.data() + channel * kPlane;
    std::fill(plane, plane + kPlane, -kMeans[channel] / kDeviations[channel]);
    for (int row = 0; row < picture.rows; ++row) {
      const auto* pixels = picture.ptr<cv::Vec3b>(row);
      for (int column = 0; column < picture.cols; ++column) {
        plane[row * TextDetector::kColumns + column] =
            (static_cast<float>(pixels[column][channel]) / 255.0f - kMeans[channel]) / kDeviations[channel];
      }
    }
  }
  return input;
}

double meanWithin(const cv::Mat& probability, const std::vector<cv::Point>& outline) {
  const cv::Rect box = cv::boundingRect(outline);
  cv::Mat mask = cv::Mat::zeros(box.size(), CV_8U);
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{outline}, 255, cv::LINE_8, 0, -box.tl());
  return cv::mean(probability(box), mask)[0];
}

// The corners in the order of Corners, for text that runs from left to right.
Corners inReadingOrder(const cv::RotatedRect& rectangle) {
  std::array<cv::Point2f, 4> corners;
  rectangle.points(corners.data());
  std::sort(corners.begin(), corners.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  if (corners[0].y > corners[1].y) std::swap(corners[0], corners[1]);
  if (corners[2].y > corners[3].y) std::swap(corners[2], corners[3]);
  const auto point = [&](int i) { return Vector2f(corners[i].x, corners[i].y); };
  return {point(0), point(2), point(3), point(1)};
}

}  // namespace

TextDetector::TextDetector(std::shared_ptr<const net::Network> network) : network_(std::move(network)) {
  const auto shape = [&]() -> std::vector<int> {
    try {
      return network_->run(inputOf(cv::Mat::zeros(kRows, kColumns, CV_8UC3))).shape;
    } catch (const base::Error&) {
      return {};  // the network takes another input
    }
  }();
  if (shape != std::vector<int>{1, 1, kRows, kColumns})
    throw base::Error(base::ExitCode::unreadable_input,
                      network_->path() + ": is not the network that finds text; scripts/models --force fetches it");
}

std::vector<TextLine> TextDetector::detect(const cv::Mat& picture) const {
  if (picture.empty()) return {};
  const double scale = std::min({1.0 * kColumns / picture.cols, 1.0 * kRows / picture.rows, 4.0});
  cv::Mat small;
  cv::resize(picture, small,
             {std::clamp(static_cast<int>(picture.cols * scale), 1, kColumns),
              std::clamp(static_cast<int>(picture.rows * scale), 1, kRows)},
             0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  auto output = network_->run(inputOf(small));
  const cv::Mat probability(kRows, kColumns, CV_32F, output.values.data());
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(probability > kInCore, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<TextLine> lines;
  const Vector2f unscale(static_cast<float>(picture.cols) / small.cols, static_cast<float>(picture.rows) / small.rows);
  for (const auto& outline : outlines) {
    cv::RotatedRect rectangle = cv::minAreaRect(outline);
    if (std::min(rectangle.size.width, rectangle.size.height) < kThinnestCore) continue;
    const double score = meanWithin(probability, outline);
    if (score < kLeastScore) continue;
    const float growth = kGrowth * rectangle.size.area() / (rectangle.size.width + rectangle.size.height);
    rectangle.size += cv::Size2f(growth, growth);
    TextLine line{inReadingOrder(rectangle), score};
    for (auto& corner : line.quad)
      corner = (corner + Vector2f::Constant(0.5f)).cwiseProduct(unscale) - Vector2f::Constant(0.5f);
    lines.push_back(line);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return middleOf(a.quad).y() < middleOf(b.quad).y(); });
  return lines;
}

}  // namespace omnimapper::signs
