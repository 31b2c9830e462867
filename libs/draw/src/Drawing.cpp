#include <omnimapper/draw/Drawing.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace omnimapper::draw {

namespace {

double distanceToSegment(double x, double y, PixelPoint a, PixelPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double along = squared > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(x - a.x - along * dx, y - a.y - along * dy);
}

void blend(Rgb& pixel, const Pen& pen, double inked) {
  const auto mix = [&](std::uint8_t under, std::uint8_t over) {
    return static_cast<std::uint8_t>(std::lround(under + inked * pen.opacity * (over - under)));
  };
  pixel = {mix(pixel.r, pen.colour.r), mix(pixel.g, pen.colour.g), mix(pixel.b, pen.colour.b)};
}

/// Coverage of each touched pixel by ink: the largest one by any segment.
class Coverage {
 public:
  Coverage(const Image& image, double width) : image_(image), radius_(0.5 * width) {}

  void add(PixelPoint a, PixelPoint b) {
    const double reach = radius_ + 1;
    const int first_row = clampRow(std::min(a.y, b.y) - reach), last_row = clampRow(std::max(a.y, b.y) + reach);
    for (int y = first_row; y <= last_row; ++y) {
      // Only the stretch of a row that the segment's band crosses is visited.
      const double low = y - reach, high = y + 1 + reach;
      double left = std::min(a.x, b.x), right = std::max(a.x, b.x);
      if (std::abs(b.y - a.y) > 1e-9) {
        const double slope = (b.x - a.x) / (b.y - a.y);
        const double x1 = a.x + (low - a.y) * slope, x2 = a.x + (high - a.y) * slope;
        left = std::max(left, std::min(x1, x2));
        right = std::min(right, std::max(x1, x2));
      }
      const int first = std::max(0, static_cast<int>(std::floor(std::max(left - reach, -1.0))));
      const int last = static_cast<int>(std::min<double>(image_.width - 1, right + reach));
      for (int x = first; x <= last; ++x) {
        const double inked = radius_ + 0.5 - distanceToSegment(x + 0.5, y + 0.5, a, b);
        if (inked > 0) put(x, y, std::min(1.0, inked));
      }
    }
  }

  void blend(Image& image, const Pen& pen) const {
    for (const auto& [index, inked] : inked_) draw::blend(image.pixels[index], pen, inked);
  }

 private:
  int clampRow(double y) const { return static_cast<int>(std::clamp<double>(std::floor(y), 0, image_.height - 1)); }
  void put(int x, int y, double inked) {
    double& most = inked_[static_cast<std::size_t>(y) * image_.width + x];
    most = std::max(most, inked);
  }

  const Image& image_;
  double radius_;
  std::unordered_map<std::size_t, double> inked_;
};

}  // namespace

void drawPath(Image& image, const std::vector<PixelPoint>& path, const Pen& pen) {
  Coverage coverage(image, pen.width);
  for (std::size_t i = 1; i < path.size(); ++i) coverage.add(path[i - 1], path[i]);
  coverage.blend(image, pen);
}

void fillAreas(Image& image, const std::vector<std::vector<PixelPoint>>& contours, const Pen& pen) {
  std::vector<double> crossings;
  for (int y = 0; y < image.height; ++y) {
    const double middle = y + 0.5;
    crossings.clear();
    for (const auto& contour : contours) {
      for (std::size_t i = 0; i < contour.size(); ++i) {
        const PixelPoint &a = contour[i], &b = contour[(i + 1) % contour.size()];
        if ((a.y <= middle) != (b.y <= middle)) crossings.push_back(a.x + (middle - a.y) * (b.x - a.x) / (b.y - a.y));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    const auto columnFrom = [&](double x) {
      return static_cast<int>(std::ceil(std::clamp<double>(x, 0, image.width) - 0.5));
    };
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int end = std::min(columnFrom(crossings[i + 1]), image.width);
      for (int x = columnFrom(crossings[i]); x < end; ++x) blend(image.at(x, y), pen, 1);
    }
  }
}

void drawLine(Image& image, PixelPoint from, PixelPoint to, const Pen& pen) {
  drawPath(image, {from, to}, pen);
}

void drawDot(Image& image, PixelPoint centre, const Pen& pen) {
  drawLine(image, centre, centre, pen);
}

}  // namespace omnimapper::draw
