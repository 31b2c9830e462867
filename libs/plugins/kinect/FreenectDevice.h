#pragma once

#include <libfreenect.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/drivers/KinectOptions.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace omnimapper::drivers {

/// A message from a Kinect.
struct FreenectMessage {
  enum class Kind { depths, picture, acceleration };
  Kind kind = Kind::depths;
  std::uint32_t ticks = 0;               ///< of the device's clock of 60 MHz; not set for accelerations
  base::Stamp arrival;                   ///< time of arrival by the host's clock
  std::vector<std::uint16_t> depths;     ///< 640 x 480, row by row
  std::vector<std::uint8_t> picture;     ///< the same, three bytes a pixel: red, green, blue
  std::array<double, 3> acceleration{};  ///< [m/s^2] along the device's axes: left, up, forward; at rest up is positive
};

/// An open Kinect, through libfreenect. A thread receives the data from USB while the reader works, and buffers a fifth
/// of a second.
class FreenectDevice {
 public:
  /// Opens it and starts its cameras. Throws Error(unreadable_input) if that fails.
  explicit FreenectDevice(const KinectOptions& options);
  ~FreenectDevice();
  FreenectDevice(const FreenectDevice&) = delete;
  FreenectDevice& operator=(const FreenectDevice&) = delete;

  /// The oldest message; none if none comes within `patience`. Throws Error(unreadable_input) once the device is lost.
  std::optional<FreenectMessage> next(std::chrono::milliseconds patience);

 private:
  void open();
  void startCameras();
  void close();
  void run();
  void readAcceleration();
  void add(FreenectMessage message);
  void fail(const std::string& reason);
  static void onDepths(freenect_device* device, void* depths, std::uint32_t ticks);
  static void onPicture(freenect_device* device, void* picture, std::uint32_t ticks);

  const KinectOptions options_;
  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
  std::vector<std::uint16_t> depth_buffer_;  // libfreenect writes into these
  std::vector<std::uint8_t> picture_buffer_;
  int failed_readings_ = 0;

  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<FreenectMessage> messages_;
  std::string failure_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace omnimapper::drivers
