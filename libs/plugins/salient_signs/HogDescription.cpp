#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "FeatureScale.h"
#include "Pixels.h"
#include "Plate.h"
#include "SignClassifier.h"

namespace omnimapper::signs {

namespace {

constexpr float kAround = 0.3f;  // margin that is cut out around a region, as a share of its longer side
constexpr float kThinnest = 2;   // [px] shortest side of a region that can be warped

double side(const Corners& corners, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  return std::max((corners[b] - corners[a]).norm(), (corners[d] - corners[c]).norm());
}

// The region, warped to the window; empty if it is outside the picture or too thin.
cv::Mat windowOf(const cv::Mat& grey, const Corners& corners, const HogOptions& options) {
  const cv::Size window(options.columns * options.cell, options.rows * options.cell);
  const auto inner = static_cast<float>(1 - 2 * options.margin);
  const auto width = static_cast<float>(side(corners, 0, 1, 3, 2)),
             height = static_cast<float>(side(corners, 0, 3, 1, 2));
  const float padding = kAround * std::max(width, height);
  const cv::Rect2f bounds = boundsOf(corners);
  const cv::Rect cut =
      cv::Rect(cv::Point(cvFloor(bounds.x - padding), cvFloor(bounds.y - padding)),
               cv::Point(cvCeil(bounds.x + bounds.width + padding), cvCeil(bounds.y + bounds.height + padding))) &
      cv::Rect(0, 0, grey.cols, grey.rows);
  if (cut.width < kThinnest || cut.height < kThinnest || !(std::min(width, height) >= kThinnest)) return {};
  // The region is first averaged to about the window's size, because warping samples single pixels.
  const float scale = std::min(1.0f, std::max(static_cast<float>(window.width) * inner / width,
                                              static_cast<float>(window.height) * inner / height));
  const cv::Size size(std::max(2, cvRound(scale * static_cast<float>(cut.width))),
                      std::max(2, cvRound(scale * static_cast<float>(cut.height))));
  cv::Mat small, warped;
  cv::resize(grey(cut), small, size, 0, 0, cv::INTER_AREA);
  const float across = static_cast<float>(size.width) / static_cast<float>(cut.width),
              down = static_cast<float>(size.height) / static_cast<float>(cut.height);
  cv::Point2f from[4], to[4];
  const auto left = static_cast<float>(options.margin * window.width),
             top = static_cast<float>(options.margin * window.height);
  for (std::size_t i = 0; i < 4; ++i) {
    from[i] = {(corners[i].x() - static_cast<float>(cut.x) + 0.5f) * across - 0.5f,
               (corners[i].y() - static_cast<float>(cut.y) + 0.5f) * down - 0.5f};
    to[i] = {(i == 0 || i == 3 ? left : static_cast<float>(window.width) - left) - 0.5f,
             (i < 2 ? top : static_cast<float>(window.height) - top) - 0.5f};
  }
  const cv::Mat warp = cv::getPerspectiveTransform(from, to);
  if (!cv::checkRange(warp)) return {};
  cv::warpPerspective(small, warped, warp, window, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return warped;
}

}  // namespace

const base::OptionTable<HogOptions>& HogOptions::table() {
  using O = HogOptions;
  static const auto table =
      base::OptionTable<O>()
          .integer("columns", &O::columns, {1, 16}, "Number of HOG cells across the window.")
          .integer("rows", &O::rows, {1, 16}, "Number of HOG cells down the window.")
          .integer("cell_px", &O::cell, {2, 32}, "Side of a HOG cell.")
          .integer("block", &O::block, {1, 16},
                   "Number of HOG cells across a block, over which contrast is normalized.")
          .integer("orientations", &O::orientations, {2, 36}, "Number of edge orientations over half a turn.")
          .number("margin", &O::margin, {0, 0.4},
                  "Share of the window on each side that shows the surroundings of the region.");
  return table;
}

std::vector<SignFeatures> describe(const camera::ColourImage& picture, const std::vector<Corners>& regions,
                                   const HogOptions& options) {
  const cv::Mat grey = greyOf(matOf(picture), picture.order);
  const cv::Size cell(options.cell, options.cell), window(options.columns * options.cell, options.rows * options.cell);
  const cv::HOGDescriptor hog(window, cell * options.block, cell, cell, options.orientations, 1, -1,
                              cv::HOGDescriptor::L2Hys, 0.2, true, cv::HOGDescriptor::DEFAULT_NLEVELS, false);
  std::vector<SignFeatures> all;
  std::vector<float> values;
  for (const Corners& corners : regions) {
    SignFeatures features(static_cast<std::size_t>(options.length()), 0);
    const cv::Mat pixels = windowOf(grey, corners, options);
    if (!pixels.empty()) {
      hog.compute(pixels, values);
      std::transform(values.begin(), values.end(), features.begin(), [](float value) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(value * kFeatureScale), 0L, 255L));
      });
    }
    all.push_back(std::move(features));
  }
  return all;
}

}  // namespace omnimapper::signs
