#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace omnimapper::drivers {

/// A depth image of a Kinect as it is handed out, with its picture.
struct KinectFrame {
  double seconds = 0;  ///< of the device, when the depths were taken
  base::Stamp stamp;   ///< the same, of the host
  std::vector<std::uint16_t> depths;
  std::vector<std::uint8_t> picture;  ///< empty: there is none of that time
};

/// Finds the picture of a depth image: the nearest in time. A Kinect's two cameras take turns of their own.
class FramePairing {
 public:
  /// `largest_difference` [s] between a depth image and its picture.
  explicit FramePairing(double largest_difference) : largest_difference_(largest_difference) {}

  void add(KinectFrame depths) { depths_.push_back(std::move(depths)); }
  void addPicture(double seconds, std::vector<std::uint8_t> picture);

  /// The oldest depth image for which no better picture can come any more; with `at_once` it is not waited for.
  std::optional<KinectFrame> take(bool at_once);
  bool isWaiting() const { return !depths_.empty(); }

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
