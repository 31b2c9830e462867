#include <omnimapper/testing/MarkerPicture.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/aruco.hpp>

namespace omnimapper::testing {

namespace {

constexpr int kCells = 6;        // along a side, black border included
constexpr double kPlate = 0.25;  // width of the white border, in parts of the side
constexpr int kSamples = 6;      // along each side of a pixel
constexpr double kWall = 128, kBlack = 25, kWhite = 230;

// Homography from columns and rows to the marker, whose black square is [0, 1] x [0, 1], to the right and down.
Eigen::Matrix3d markerFromImage(const MarkerCorners& corners) {
  const Eigen::Vector2d square[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Eigen::Matrix<double, 8, 8> a;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const double x = square[i].x(), y = square[i].y();
    for (int k = 0; k < 2; ++k) {
      const double there = corners[static_cast<std::size_t>(i)][k];
      a.row(2 * i + k).setZero();
      a.block<1, 3>(2 * i + k, 3 * k) << x, y, 1;
      a.block<1, 2>(2 * i + k, 6) << -x * there, -y * there;
      b[2 * i + k] = there;
    }
  }
  const Eigen::Matrix<double, 8, 1> h = a.fullPivLu().solve(b);
  Eigen::Matrix3d image_from_marker;
  image_from_marker << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return image_from_marker.inverse();
}

// Brightness of the plate at a point of the marker; negative outside of the plate.
double shadeAt(const cv::Mat& cells, const Eigen::Vector3d& homogeneous) {
  const double x = homogeneous.x() / homogeneous.z(), y = homogeneous.y() / homogeneous.z();
  if (!(x > -kPlate && x < 1 + kPlate && y > -kPlate && y < 1 + kPlate)) return -1;
  if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return kWhite;
  return cells.at<std::uint8_t>(static_cast<int>(y * kCells), static_cast<int>(x * kCells)) > 127 ? kWhite : kBlack;
}

}  // namespace

MarkerPicture::MarkerPicture(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), static_cast<std::uint8_t>(kWall)) {}

void MarkerPicture::draw(int id, const MarkerCorners& corners) {
  cv::Mat cells;
  cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50)->drawMarker(id, kCells, cells, 1);
  const Eigen::Matrix3d marker_from_image = markerFromImage(corners);
  Eigen::Vector2d low = corners[0], high = corners[0];
  for (const auto& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double margin = 2 * kPlate * (high - low).maxCoeff() + 1;  // wide enough for the plate in perspective
  const auto clamped = [](double place, int size) { return static_cast<int>(std::clamp<double>(place, 0, size)); };
  for (int v = clamped(low.y() - margin, height_); v < clamped(high.y() + margin, height_); ++v) {
    for (int u = clamped(low.x() - margin, width_); u < clamped(high.x() + margin, width_); ++u) {
      auto& pixel =
          pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      double sum = 0;
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const double right = (k % kSamples + 0.5) / kSamples - 0.5, down = (k / kSamples + 0.5) / kSamples - 0.5;
        const double shade = shadeAt(cells, marker_from_image * Eigen::Vector3d(u + right, v + down, 1));
        sum += shade < 0 ? pixel : shade;
      }
      pixel = static_cast<std::uint8_t>(std::lround(sum / (kSamples * kSamples)));
    }
  }
}

mrpt::img::CImage MarkerPicture::grey() const {
  mrpt::img::CImage image(static_cast<unsigned>(width_), static_cast<unsigned>(height_), mrpt::img::CH_GRAY);
  for (int v = 0; v < height_; ++v) {
    const auto* row = &pixels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_)];
    std::copy(row, row + width_, image.ptrLine<std::uint8_t>(static_cast<unsigned>(v)));
  }
  return image;
}

mrpt::img::CImage MarkerPicture::colour() const {
  mrpt::img::CImage image;
  grey().colorImage(image);
  return image;
}

}  // namespace omnimapper::testing
