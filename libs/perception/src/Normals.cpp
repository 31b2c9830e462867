#include <omnimapper/base/Error.h>
#include <omnimapper/perception/Normals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "DepthSensor.h"
#include "planes/WindowPlanes.h"

namespace omnimapper::perception {

namespace {

// A pixel is on a plane if it is within this many standard deviations of it.
constexpr double kSigmas = 4;

/// Propagates normals to pixels that have none, from pixel to adjacent pixel, if the pixel is on the plane of the one
/// before.
class Spreading {
 public:
  Spreading(const planes::InverseDepth& inverse, const camera::Pinhole& camera, double tolerance, int most_steps,
            NormalImage& normals)
      : inverse_(inverse),
        tolerance_(static_cast<float>(tolerance)),
        most_steps_(static_cast<std::uint8_t>(most_steps)),
        width_(normals.width),
        height_(normals.height),
        normals_{normals.values.get(), normals.values.get() + normals.size(),
                 normals.values.get() + 2 * normals.size()},
        steps_(normals.size(), 0) {
    for (int x = 0; x < width_; ++x) across_.push_back(static_cast<float>((x - camera.cx) / camera.fx));
    for (int y = 0; y < height_; ++y) down_.push_back(static_cast<float>((y - camera.cy) / camera.fy));
  }

  void spread() {
    std::vector<std::array<int, 2>> missing;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (needsOne(x, y) && !takeFrom(x, y, -1)) missing.push_back({x, y});
      }
    }
    for (auto pixel = missing.rbegin(); pixel != missing.rend(); ++pixel) takeFrom((*pixel)[0], (*pixel)[1], 1);
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  bool needsOne(int x, int y) const { return std::isnan(normals_.z[index(x, y)]) && *inverse_.at(x, y) > 0; }

  // Normal times ray, which is proportional to 1/z on a plane with this normal.
  float slant(std::size_t normal, int x, int y) const {
    return normals_.x[normal] * across_[static_cast<std::size_t>(x)] +
           normals_.y[normal] * down_[static_cast<std::size_t>(y)] + normals_.z[normal];
  }

  // Takes the normal of the horizontal or the vertical neighbour in the direction of `step`, preferably of the one
  // whose normal was propagated over fewer pixels.
  bool takeFrom(int x, int y, int step) {
    const bool beside = x + step >= 0 && x + step < width_, beyond = y + step >= 0 && y + step < height_;
    if (!beside || !beyond) return (beside && take(x, y, x + step, y)) || (beyond && take(x, y, x, y + step));
    if (steps_[index(x + step, y)] <= steps_[index(x, y + step)]) {
      return take(x, y, x + step, y) || take(x, y, x, y + step);
    }
    return take(x, y, x, y + step) || take(x, y, x + step, y);
  }

  bool take(int x, int y, int from_x, int from_y) {
    const std::size_t from = index(from_x, from_y), to = index(x, y);
    if (std::isnan(normals_.z[from]) || steps_[from] >= most_steps_) return false;
    const float expected = *inverse_.at(from_x, from_y) * slant(from, x, y) / slant(from, from_x, from_y);
    if (!(std::abs(*inverse_.at(x, y) - expected) <= tolerance_)) return false;
    normals_.x[to] = normals_.x[from];
    normals_.y[to] = normals_.y[from];
    normals_.z[to] = normals_.z[from];
    steps_[to] = static_cast<std::uint8_t>(steps_[from] + 1);
    return true;
  }

  const planes::InverseDepth& inverse_;
  float tolerance_;
  std::uint8_t most_steps_;
  int width_, height_;
  planes::NormalRow normals_;         // normals of all pixels
  std::vector<std::uint8_t> steps_;   // number of pixels over which a normal was propagated
  std::vector<float> across_, down_;  // x and y of the rays of each column and row
};

}  // namespace

NormalEstimator::NormalEstimator(const NormalOptions& options) : options_(options) {
  using base::option_text::format;
  const auto refuse = [](const std::string& what) { throw base::Error(base::ExitCode::out_of_range, what); };
  if (options.radius < 1 || options.radius > 7)
    refuse("normals: a window radius of " + std::to_string(options.radius) + " px: must be in [1, 7]");
  if (!(options.noise_at_1m > 0) || !(options.step_at_1m >= 0)) {
    refuse("normals: noise_at_1m_m = " + format(options.noise_at_1m) +
           " must be > 0, step_at_1m_m = " + format(options.step_at_1m) + " must be >= 0");
  }
  refuseDepths("normals", options);
}

NormalImage NormalEstimator::estimate(const camera::DepthImage& image) const {
  NormalImage normals;
  normals.width = image.width();
  normals.height = image.height();
  const auto width = static_cast<std::size_t>(image.width());
  if (normals.size() == 0) return normals;
  // This is one block that is not zeroed and is larger than all temporary buffers, so that the allocator reuses memory
  // that was freed before.
  normals.values.reset(new float[3 * normals.size()]);
  const planes::InverseDepth inverse = planes::invert(image, options_.min_depth, options_.max_depth);
  const camera::DepthNoise noise{options_.noise_at_1m, options_.step_at_1m, 0, 1};
  const double tolerance = kSigmas * std::sqrt(noise.pixelVariance());
  planes::WindowPlanes windows(inverse, image.camera(), options_.radius, 1 / options_.min_depth, tolerance);
  float* const to = normals.values.get();
  for (std::size_t first = 0; first < normals.size(); first += width) {
    windows.next({to + first, to + normals.size() + first, to + 2 * normals.size() + first});
  }
  Spreading(inverse, image.camera(), tolerance, 2 * options_.radius, normals).spread();
  return normals;
}

}  // namespace omnimapper::perception
