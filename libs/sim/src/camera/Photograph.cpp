#include "Photograph.h"

#include <algorithm>
#include <cmath>

#include "CameraNoise.h"
#include "Srgb.h"

namespace omnimapper::sim {

namespace {

using Picture = std::vector<Eigen::Vector3f>;
constexpr float kReadNoise = 0.25f;  // noise in the dark, as a part of that at full white
constexpr int kMostTaps = 15;
constexpr float kFarAway = 100;  // distance assumed for the motion of pixels that see nothing [m]

/// Motion of a pixel's point in the picture during the exposure.
class Smear {
 public:
  Smear(const Frame& frame, const geometry::Se3& map_from_begin, const geometry::Se3& map_from_end)
      : frame_(frame), begin_(frame, map_from_begin), end_(frame, map_from_end) {
    const Pinhole& camera = frame.camera;
    first_ = camera.through(0, 0).cast<float>();
    step_x_ = static_cast<float>(1 / camera.fx);
    step_y_ = static_cast<float>(1 / camera.fy);
  }

  Eigen::Vector2f at(int column, int row) const {
    const auto hit_depth = static_cast<float>(frame_.at(column, row).depth);
    const float depth = hit_depth > 0 ? hit_depth : kFarAway;
    const Eigen::Vector3f point = depth * Eigen::Vector3f(first_.x() + column * step_x_, first_.y() + row * step_y_, 1);
    const Eigen::Vector3f begin = begin_.project * point + begin_.shift, end = end_.project * point + end_.shift;
    if (begin.z() < kNear || end.z() < kNear) return Eigen::Vector2f::Zero();
    return end.head<2>() / end.z() - begin.head<2>() / begin.z();
  }

  /// Length of the longest motion on a coarse grid [pixel].
  float longest() const {
    float most = 0;
    for (int row = 0; row < frame_.camera.height; row += 16) {
      for (int column = 0; column < frame_.camera.width; column += 16) most = std::max(most, at(column, row).norm());
    }
    return most;
  }

 private:
  static constexpr float kNear = 1e-3f;  // points nearer than this are not projected [m]
  /// From the optical frame to a picture's homogeneous pixels.
  struct Projection {
    Projection(const Frame& frame, const geometry::Se3& map_from_other) {
      const geometry::Se3 other_from_optical = geometry::inverse(map_from_other) * frame.map_from_optical;
      Eigen::Matrix3d intrinsic = Eigen::Matrix3d::Identity();
      intrinsic(0, 0) = frame.camera.fx;
      intrinsic(1, 1) = frame.camera.fy;
      intrinsic(0, 2) = frame.camera.cx;
      intrinsic(1, 2) = frame.camera.cy;
      project = (intrinsic * other_from_optical.rotation.toRotationMatrix()).cast<float>();
      shift = (intrinsic * other_from_optical.translation).cast<float>();
    }
    Eigen::Matrix3f project;
    Eigen::Vector3f shift;
  };
  const Frame& frame_;
  Projection begin_, end_;
  Eigen::Vector3f first_;
  float step_x_, step_y_;
};

Picture smeared(const Picture& sharp, const Pinhole& camera, const Smear& smear) {
  Picture picture(sharp.size());
  const auto nearest = [](float at, int size) { return std::clamp(static_cast<int>(at + 0.5f), 0, size - 1); };
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const Eigen::Vector2f motion = smear.at(column, row);
      const int taps = std::min(static_cast<int>(motion.norm()) + 1, kMostTaps);
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int tap = 0; tap < taps; ++tap) {
        const float share = (tap + 0.5f) / taps - 0.5f;
        const int x = nearest(column + share * motion.x(), camera.width),
                  y = nearest(row + share * motion.y(), camera.height);
        sum += sharp[static_cast<std::size_t>(y) * camera.width + x];
      }
      picture[static_cast<std::size_t>(row) * camera.width + column] = sum / static_cast<float>(taps);
    }
  }
  return picture;
}

// Blur of the lens: a point also lights its neighbours, with weights 1 4 1 along each axis.
void soften(Picture& picture, int width, int height) {
  for (int row = 0; row < height; ++row) {
    Eigen::Vector3f* line = &picture[static_cast<std::size_t>(row) * width];
    Eigen::Vector3f left = line[0];
    for (int i = 0; i < width; ++i) {
      const Eigen::Vector3f here = line[i];
      line[i] = (left + 4 * here + line[std::min(i + 1, width - 1)]) / 6;
      left = here;
    }
  }
  Picture above(picture.begin(), picture.begin() + width);
  for (int row = 0; row < height; ++row) {
    Eigen::Vector3f* line = &picture[static_cast<std::size_t>(row) * width];
    const Eigen::Vector3f* below = row + 1 < height ? line + width : line;
    for (int i = 0; i < width; ++i) {
      const Eigen::Vector3f here = line[i];
      line[i] = (above[i] + 4 * here + below[i]) / 6;
      above[i] = here;
    }
  }
}

// sRGB of linear values 0 to 1 in steps of 1/4095.
const std::vector<std::uint8_t>& srgbTable() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> made(4096);
    for (int i = 0; i < 4096; ++i) made[i] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(i / 4095.0)));
    return made;
  }();
  return table;
}

std::uint8_t coded(float value) {
  return srgbTable()[static_cast<std::size_t>(std::clamp(value, 0.0f, 1.0f) * 4095 + 0.5f)];
}

}  // namespace

mrpt::img::CImage photograph(const Frame& frame, std::vector<Eigen::Vector3f> colours,
                             const geometry::Se3& map_from_begin, const geometry::Se3& map_from_end,
                             const PhotographSettings& settings, Random random) {
  constexpr float kVisible = 0.3f;  // pixels
  const Pinhole& camera = frame.camera;
  const Smear smear(frame, map_from_begin, map_from_end);
  if (smear.longest() > kVisible) colours = smeared(colours, camera, smear);
  soften(colours, camera.width, camera.height);
  mrpt::img::CImage image(camera.width, camera.height, mrpt::img::CH_RGB);
  const auto gain = static_cast<float>(settings.gain), noise = static_cast<float>(settings.noise);
  const float corner = std::hypot(0.5f * camera.width, 0.5f * camera.height);
  const float loss = static_cast<float>(settings.vignetting) / (corner * corner);
  for (int row = 0; row < camera.height; ++row) {
    auto* out = image.ptrLine<std::uint8_t>(row);
    const float dy = row - 0.5f * (camera.height - 1);
    for (int column = 0; column < camera.width; ++column) {
      const float dx = column - 0.5f * (camera.width - 1), light = gain * (1 - loss * (dx * dx + dy * dy));
      const Eigen::Vector3f value = light * colours[static_cast<std::size_t>(row) * camera.width + column];
      const std::array<float, 3> errors = quickGaussians(random);
      for (int channel = 0; channel < 3; ++channel) {  // the image's order is blue, green, red
        const float v = value[2 - channel];
        const float sigma = noise * (kReadNoise + (1 - kReadNoise) * std::sqrt(std::max(v, 0.0f)));
        *out++ = coded(v + sigma * errors[channel]);
      }
    }
  }
  return image;
}

}  // namespace omnimapper::sim
