#include "DisparityModel.h"

#include <algorithm>
#include <cmath>

#include "CameraNoise.h"

namespace omnimapper::sim {

namespace {

constexpr float kSameDepth = 1.0f;  // largest difference of disparities that match in one window [pixel]

constexpr float kNoDisparity = -1e6f;  // far from every other

/// Disparities on a grid of pixels; kNoDisparity where nothing can be matched.
struct Disparities {
  int width, height;
  std::vector<float> values;
  const float* line(int row) const { return &values[static_cast<std::size_t>(row) * width]; }
};

/// The least and the greatest value in the square window around each pixel, inside the picture.
class WindowExtremes {
 public:
  WindowExtremes(const Disparities& of, int half) : low_(of.values), high_(of.values) {
    const int width = of.width, height = of.height;
    std::vector<float> low(low_), high(high_);
    for (int row = 0; row < height; ++row) {
      const std::size_t line = static_cast<std::size_t>(row) * width;
      for (int by = -half; by <= half; ++by) {
        for (int i = std::max(0, -by); i < std::min(width, width - by); ++i) {
          low[line + i] = std::min(low[line + i], of.values[line + i + by]);
          high[line + i] = std::max(high[line + i], of.values[line + i + by]);
        }
      }
    }
    low_ = low;
    high_ = high;
    for (int row = 0; row < height; ++row) {
      for (int other = std::max(0, row - half); other <= std::min(height - 1, row + half); ++other) {
        const std::size_t line = static_cast<std::size_t>(row) * width, from = static_cast<std::size_t>(other) * width;
        for (int i = 0; i < width; ++i) {
          low_[line + i] = std::min(low_[line + i], low[from + i]);
          high_[line + i] = std::max(high_[line + i], high[from + i]);
        }
      }
    }
  }
  /// Whether no value is missing in the window and all of them match.
  bool isSmooth(std::size_t pixel) const { return low_[pixel] > 0 && high_[pixel] - low_[pixel] <= kSameDepth; }
  float highest(std::size_t pixel) const { return high_[pixel]; }

 private:
  std::vector<float> low_, high_;
};

/// The square window around a pixel, as far as it is in the picture.
class Window {
 public:
  Window(const Disparities& disparities, int column, int row, int half)
      : disparities_(disparities),
        left_(std::max(0, column - half)),
        right_(std::min(disparities.width - 1, column + half)),
        top_(std::max(0, row - half)),
        bottom_(std::min(disparities.height - 1, row + half)) {}

  int size() const { return (right_ - left_ + 1) * (bottom_ - top_ + 1); }

  bool hasEnough(float with, double enough) const {
    int count = 0;
    for (int row = top_; row <= bottom_; ++row) {
      const float* line = disparities_.line(row);
      for (int i = left_; i <= right_; ++i) count += std::abs(line[i] - with) <= kSameDepth;
      if (count > 0 && count >= enough) return true;
    }
    return false;
  }
  float meanOf(float with) const {
    float sum = 0;
    int count = 0;
    for (int row = top_; row <= bottom_; ++row) {
      const float* line = disparities_.line(row);
      for (int i = left_; i <= right_; ++i) {
        if (std::abs(line[i] - with) <= kSameDepth) sum += line[i], ++count;
      }
    }
    return sum / static_cast<float>(count);
  }
  float farthest() const {
    float least = 1e9f;
    for (int row = top_; row <= bottom_; ++row) {
      const float* line = disparities_.line(row);
      for (int i = left_; i <= right_; ++i) least = line[i] > 0 ? std::min(least, line[i]) : least;
    }
    return least;
  }

 private:
  const Disparities& disparities_;
  int left_, right_, top_, bottom_;
};

/// The disparity that a window at a depth edge matches: that of its middle if enough of the window has it, else the
/// nearest, else the farthest, else 0. So edges move by a few pixels to either side, and narrow shadows close.
float matchAtEdge(const Disparities& disparities, int column, int row, int half, float nearest, double need) {
  const Window window(disparities, column, row, half);
  const double enough = need * window.size();
  const float middle = disparities.line(row)[column];
  if (middle > 0 && window.hasEnough(middle, enough)) return middle;
  if (window.hasEnough(nearest, enough)) return window.meanOf(nearest);
  const float farthest = window.farthest();
  if (window.hasEnough(farthest, enough)) return window.meanOf(farthest);
  return 0;
}

// Disparities of the pixels that both eyes see, where the signal suffices. Weak signals fail in patches, not in single
// pixels.
Disparities visibleDisparities(const Frame& frame, const Scene& scene, const std::vector<float>& signal,
                               const DisparitySettings& settings, Random& random) {
  const Pinhole& camera = frame.camera;
  Disparities disparities{camera.width, camera.height, std::vector<float>(frame.pixels.size(), kNoDisparity)};
  const std::vector<char> shadow = findShadow(frame, scene, {settings.baseline, 0, 0});
  const std::vector<float> fine = smoothNoise(camera.width, camera.height, 3, random),
                           coarse = smoothNoise(camera.width, camera.height, 11, random);
  const auto spread = static_cast<float>(settings.signal_spread * std::sqrt(0.5));
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    const double depth = frame.pixels[i].depth;
    if (depth <= 0 || shadow[i] || signal[i] <= 0) continue;
    const float chance = spread * (fine[i] + coarse[i]);
    if (chance < std::log(static_cast<float>(settings.signal_floor) / signal[i])) continue;
    disparities.values[i] = static_cast<float>(camera.fx * settings.baseline / depth);
  }
  return disparities;
}

}  // namespace

std::vector<float> patternSignal(const Scenes& scenes, const Frame& frame) {
  std::vector<float> signal(frame.pixels.size(), 0.0f);
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const PixelHit& hit = frame.pixels[i];
    if (hit.surface < 0) continue;
    const Material& material = scenes.material(hit.surface);
    const float back = material.infrared * (1 - material.transmission) * (1 - material.transmission);
    signal[i] = back * hit.cosine / static_cast<float>(hit.depth * hit.depth);
  }
  return signal;
}

std::vector<float> textureSignal(const std::vector<Eigen::Vector3f>& colours, int width, int height, int window) {
  std::vector<float> grey(colours.size());
  for (std::size_t i = 0; i < grey.size(); ++i)
    grey[i] = std::sqrt(std::max(0.0f, colours[i].dot(Eigen::Vector3f(0.21f, 0.72f, 0.07f))));
  // Sums over the window come from an integral image.
  std::vector<double> sums(static_cast<std::size_t>(width + 1) * (height + 1), 0.0);
  const auto sum = [&](int column, int row) -> double& {
    return sums[static_cast<std::size_t>(row) * (width + 1) + column];
  };
  for (int row = 0; row < height; ++row) {
    const float* line = &grey[static_cast<std::size_t>(row) * width];
    for (int column = 0; column < width; ++column) {
      const float slope = 0.5f * (line[std::min(column + 1, width - 1)] - line[std::max(column - 1, 0)]);
      sum(column + 1, row + 1) = slope * slope + sum(column, row + 1) + sum(column + 1, row) - sum(column, row);
    }
  }
  std::vector<float> signal(colours.size());
  for (int row = 0; row < height; ++row) {
    const int top = std::max(0, row - window / 2), bottom = std::min(height, row + window / 2 + 1);
    for (int column = 0; column < width; ++column) {
      const int left = std::max(0, column - window / 2), right = std::min(width, column + window / 2 + 1);
      signal[static_cast<std::size_t>(row) * width + column] =
          static_cast<float>((sum(right, bottom) - sum(left, bottom) - sum(right, top) + sum(left, top)) /
                             ((right - left) * (bottom - top)));
    }
  }
  return signal;
}

std::vector<float> senseDepth(const Frame& frame, const Scene& scene, const std::vector<float>& signal,
                              const DisparitySettings& settings, Random random) {
  const Pinhole& camera = frame.camera;
  const Disparities disparities = visibleDisparities(frame, scene, signal, settings, random);
  const std::vector<float> error = smoothNoise(camera.width, camera.height, settings.reach, random),
                           ragged = smoothNoise(camera.width, camera.height, 4, random);
  const int half = settings.window / 2;
  const WindowExtremes extremes(disparities, half);
  const double focal_baseline = camera.fx * settings.baseline;
  std::vector<float> depths(frame.pixels.size(), 0.0f);
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width - settings.blank_columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * camera.width + column;
      if (extremes.highest(i) <= 0) continue;
      const double need = settings.need + settings.need_spread * ragged[i];
      const float matched = extremes.isSmooth(i)
                                ? disparities.values[i]
                                : matchAtEdge(disparities, column, row, half, extremes.highest(i), need);
      if (matched <= 0) continue;
      // Near the signal floor the errors double.
      const double weakness = signal[i] > 0 ? std::min(1.0, settings.signal_floor / signal[i]) : 1.0;
      double disparity = matched + settings.sigma * (1 + weakness) * error[i];
      if (settings.step > 0) disparity = settings.step * std::round(disparity / settings.step);
      if (disparity <= 0) continue;
      const double depth = focal_baseline / disparity;
      if (depth >= settings.min_range && depth <= settings.max_range) depths[i] = static_cast<float>(depth);
    }
  }
  return depths;
}

std::vector<float> registerDepth(const std::vector<float>& depths, const Pinhole& from, const Pinhole& to,
                                 const geometry::Se3& to_from_from) {
  std::vector<float> registered(to.count(), 0.0f);
  const Eigen::Matrix3d rotation = to_from_from.rotation.toRotationMatrix();
  for (int row = 0; row < from.height; ++row) {
    for (int column = 0; column < from.width; ++column) {
      const float depth = depths[static_cast<std::size_t>(row) * from.width + column];
      if (depth <= 0) continue;
      const Eigen::Vector3d point = rotation * (depth * from.through(column, row)) + to_from_from.translation;
      const auto pixel = to.project(point);
      if (!pixel || !to.contains(*pixel)) continue;
      const auto u = static_cast<std::size_t>(std::lround(pixel->x())),
                 v = static_cast<std::size_t>(std::lround(pixel->y()));
      float& there = registered[v * to.width + u];
      const auto z = static_cast<float>(point.z());
      if (there == 0 || z < there) there = z;
    }
  }
  return registered;
}

}  // namespace omnimapper::sim
