#include "MarkerFinder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "EdgeRefinement.h"

namespace omnimapper::perception::markers {

namespace {

using Options = ArucoMarkerOptions;

cv::aruco::PREDEFINED_DICTIONARY_NAME nameOf(Options::Dictionary dictionary) {
  using D = Options::Dictionary;
  switch (dictionary) {
    case D::dict_4x4_50:
      return cv::aruco::DICT_4X4_50;
    case D::dict_4x4_100:
      return cv::aruco::DICT_4X4_100;
    case D::dict_4x4_250:
      return cv::aruco::DICT_4X4_250;
    case D::dict_4x4_1000:
      return cv::aruco::DICT_4X4_1000;
    case D::dict_5x5_50:
      return cv::aruco::DICT_5X5_50;
    case D::dict_5x5_100:
      return cv::aruco::DICT_5X5_100;
    case D::dict_5x5_250:
      return cv::aruco::DICT_5X5_250;
    case D::dict_5x5_1000:
      return cv::aruco::DICT_5X5_1000;
    case D::dict_6x6_50:
      return cv::aruco::DICT_6X6_50;
    case D::dict_6x6_100:
      return cv::aruco::DICT_6X6_100;
    case D::dict_6x6_250:
      return cv::aruco::DICT_6X6_250;
    case D::dict_6x6_1000:
      return cv::aruco::DICT_6X6_1000;
    case D::dict_7x7_50:
      return cv::aruco::DICT_7X7_50;
    case D::dict_7x7_100:
      return cv::aruco::DICT_7X7_100;
    case D::dict_7x7_250:
      return cv::aruco::DICT_7X7_250;
    case D::dict_7x7_1000:
      return cv::aruco::DICT_7X7_1000;
    case D::original:
      return cv::aruco::DICT_ARUCO_ORIGINAL;
    case D::april_16h5:
      return cv::aruco::DICT_APRILTAG_16h5;
    case D::april_25h9:
      return cv::aruco::DICT_APRILTAG_25h9;
    case D::april_36h10:
      return cv::aruco::DICT_APRILTAG_36h10;
    case D::april_36h11:
      return cv::aruco::DICT_APRILTAG_36h11;
  }
  return cv::aruco::DICT_4X4_50;
}

// The picture in grey; without pixels if it is not of 8 bits with 1 or 3 channels.
cv::Mat greyOf(const mrpt::img::CImage& picture) {
  if (picture.isEmpty() || picture.getPixelDepth() != mrpt::img::PixelDepth::D8U) return {};
  const auto pixels = picture.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
  if (pixels.channels() == 1) return pixels;
  if (pixels.channels() != 3) return {};
  cv::Mat grey;
  cv::cvtColor(pixels, grey,
               picture.getChannelsOrder() == std::string("RGB") ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  return grey;
}

camera::ColourImage viewOf(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, static_cast<int>(grey.step), camera::ColourImage::Order::grey};
}

double shortestSide(const std::vector<cv::Point2f>& corners) {
  double shortest = cv::norm(corners.back() - corners.front());
  for (std::size_t i = 1; i < corners.size(); ++i) shortest = std::min(shortest, cv::norm(corners[i] - corners[i - 1]));
  return shortest;
}

// Moves the corners to where the gradients around them indicate.
void refineByGradients(const cv::Mat& grey, int cells, std::vector<cv::Point2f>& corners) {
  constexpr double kWindow = 1;  // [cell] half the side of the window
  constexpr int kLargest = 5;    // [px] half the side of the window
  constexpr int kSteps = 30;
  constexpr double kSettled = 0.01;  // [px]
  const int half = std::clamp(static_cast<int>(kWindow * shortestSide(corners) / cells), 1, kLargest);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kSteps, kSettled});
}

}  // namespace

std::vector<FoundMarker> findMarkers(const mrpt::img::CImage& picture, const Options& options) {
  const cv::Mat grey = greyOf(picture);
  if (!(std::min(grey.cols, grey.rows) > options.min_side)) return {};
  const auto dictionary = cv::aruco::getPredefinedDictionary(nameOf(options.dictionary));
  const auto settings = cv::aruco::DetectorParameters::create();
  settings->minMarkerPerimeterRate = 4 * options.min_side / std::max(grey.cols, grey.rows);
  std::vector<std::vector<cv::Point2f>> outlines;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey, dictionary, outlines, ids, settings);
  const int cells = dictionary->markerSize + 2 * settings->markerBorderBits;
  std::vector<FoundMarker> found;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (shortestSide(outlines[i]) < options.min_side) continue;
    if (options.refinement == Options::Refinement::gradients) refineByGradients(grey, cells, outlines[i]);
    FoundMarker marker{ids[i], {}};
    for (std::size_t k = 0; k < 4; ++k) marker.corners[k] = {outlines[i][k].x, outlines[i][k].y};
    if (options.refinement == Options::Refinement::edges)
      marker.corners = refinedByEdges(viewOf(grey), marker.corners, cells);
    found.push_back(marker);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return found;
}

}  // namespace omnimapper::perception::markers
