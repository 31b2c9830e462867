#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace omnimapper::drivers {

/// A depth image of a Kinect, with its picture.
struct KinectFrame {
  double seconds = 0;  ///< time of the depths, by the device's clock
  base::Stamp stamp;   ///< the same, by the host's clock
  std::vector<std::uint16_t> depths;
  std::vector<std::uint8_t> picture;  ///< empty if there is none of that time
};

/// Finds for a depth image the picture that is nearest in time. A Kinect's two cameras are not synchronized.
class FramePairing {
 public:
  /// `largest_difference` [s] between a depth image and its picture.
  explicit FramePairing(double largest_difference) : largest_difference_(largest_difference) {}

  void add(KinectFrame depths) { depths_.push_back(std::move(depths)); }
  void addPicture(double seconds, std::vector<std::uint8_t> picture);

  /// The oldest depth image, if no better picture for it can come any more; with `at_once`, without this condition.
  std::optional<KinectFrame> take(bool at_once);

 private:
  struct Picture {
    double seconds;
    std::vector<std::uint8_t> pixels;
  };
  double largest_difference_;
  std::deque<KinectFrame> depths_;
  std::deque<Picture> pictures_;
};

}  // namespace omnimapper::drivers
