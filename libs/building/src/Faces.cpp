#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "Walls.h"

namespace omnimapper::building {

namespace {

using Contour = std::vector<cv::Point>;

/// The line of a contour's part between two corners, fitted to the cells that are not at the corners.
std::pair<cv::Point2d, cv::Point2d> fittedLine(const Contour& part, double cell) {
  constexpr double kCorner = 0.1;  // [m]
  const auto trim = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(part.size()) / 5,
                                             std::max(1, static_cast<int>(kCorner / cell)));
  const Contour inner(part.begin() + trim, part.end() - trim);
  const cv::Point2d first = part.front(), last = part.back();
  if (inner.size() < 3) return {first, last};
  cv::Vec4f line;
  cv::fitLine(inner, line, cv::DIST_L2, 0, 0.01, 0.01);
  const cv::Point2d along(line[0], line[1]), point(line[2], line[3]);
  return {point + along * along.dot(first - point), point + along * along.dot(last - point)};
}

/// The parts of a closed contour between neighbouring corners, which are points of the contour in its order.
std::vector<Contour> partsOf(const Contour& contour, const Contour& corners) {
  std::vector<Contour> parts;
  auto at = static_cast<std::size_t>(std::find(contour.begin(), contour.end(), corners.front()) - contour.begin());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const cv::Point end = corners[(i + 1) % corners.size()];
    Contour part{contour[at]};
    do {
      at = (at + 1) % contour.size();
      part.push_back(contour[at]);
    } while (contour[at] != end && part.size() <= contour.size());
    parts.push_back(std::move(part));
  }
  return parts;
}

/// The face along a part of a contour: none if free space and obstacle are on both sides alike, or if the border is
/// mostly that of what has not been seen.
class FaceFinder {
 public:
  FaceFinder(const FreeSpace& space, const cv::Mat& near_occupied) : space_(space), near_occupied_(near_occupied) {}

  bool find(const Contour& part, Face& face) const {
    std::tie(face.from, face.to) = fittedLine(part, space_.cell);
    face.length = cv::norm(face.to - face.from);
    if (!(face.length > 0)) return false;
    const cv::Point2d along = (face.to - face.from) / face.length, normal(-along.y, along.x);
    const double off = kOff / space_.cell + 1;
    int left = 0, right = 0, occupied = 0;
    for (int i = 0; i < kSamples; ++i) {
      const cv::Point2d at = face.from + (face.to - face.from) * ((i + 0.5) / kSamples);
      left += space_.isFree(at + normal * off) ? 1 : 0;
      right += space_.isFree(at - normal * off) ? 1 : 0;
      const int x = cvRound(at.x), y = cvRound(at.y);
      occupied += space_.contains(x, y) && near_occupied_.at<std::uint8_t>(y, x) != 0 ? 1 : 0;
    }
    face.inward = left < right ? normal : -normal;
    return left != right && 2 * occupied >= kSamples;
  }

 private:
  static constexpr double kOff = 0.15;  // [m]
  static constexpr int kSamples = 10;
  const FreeSpace& space_;
  const cv::Mat& near_occupied_;
};

}  // namespace

std::vector<Face> facesOf(const FreeSpace& space, const SegmentationOptions& options) {
  constexpr double kNear = 0.1, kShortestContour = 1;  // [m]
  cv::Mat near_occupied;
  cv::dilate(space.occupied, near_occupied, disc(kNear / space.cell));
  std::vector<Contour> contours;
  cv::findContours(space.free, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  const FaceFinder finder(space, near_occupied);
  std::vector<Face> faces;
  for (const Contour& contour : contours) {
    if (static_cast<double>(contour.size()) * space.cell < kShortestContour) continue;
    Contour corners;
    cv::approxPolyDP(contour, corners, options.roughness / space.cell, true);
    if (corners.size() < 2) continue;
    for (const Contour& part : partsOf(contour, corners)) {
      Face face;
      if (cv::norm(part.back() - part.front()) * space.cell >= options.shortest_face && finder.find(part, face))
        faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace omnimapper::building
