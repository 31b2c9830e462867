#pragma once

#include <omnimapper/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace omnimapper::fuzz {

/// A target processes the bytes of a fuzzer, whatever they are: it must either refuse them or give a valid result. It
/// throws if it does neither.
using Target = void (*)(const std::uint8_t* data, std::size_t size);

/// Depth images, with and without a colour image, for everything that takes them.
void depthImages(const std::uint8_t* data, std::size_t size);
/// Observations of range cameras whose parts may contradict one another, for the extractors.
void rangeScans(const std::uint8_t* data, std::size_t size);
/// 2D scans for the extractors of lines (both methods) and of points.
void laserScans(const std::uint8_t* data, std::size_t size);
/// Unorganized clouds and Velodyne scans of made-up packets, for the finder of their planes.
void clouds(const std::uint8_t* data, std::size_t size);
/// Bytes of a log for the classes of `obs`.
void observations(const std::uint8_t* data, std::size_t size);
/// Bytes from a network or serial port: lines of odometry, and messages of a Hokuyo.
void sensorBytes(const std::uint8_t* data, std::size_t size);
#ifdef OMNIMAPPER_READS_ROS
/// Messages of ROS of all types that are read, also with a definition of their own.
void rosMessages(const std::uint8_t* data, std::size_t size);
#endif

/// All targets, by the names of their programs and of their folders in corpus/.
inline std::map<std::string, Target> targets() {
  std::map<std::string, Target> all{{"depth_images", depthImages},  {"range_scans", rangeScans},
                                    {"laser_scans", laserScans},    {"clouds", clouds},
                                    {"observations", observations}, {"sensor_bytes", sensorBytes}};
#ifdef OMNIMAPPER_READS_ROS
  all["ros_messages"] = rosMessages;
#endif
  return all;
}

inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Runs code that may refuse its input by an exception, which must give a reason.
template <class Run>
void mayRefuse(const Run& run) {
  try {
    run();
  } catch (const base::Error& error) {
    require(error.code() != base::ExitCode::internal, error.what());
    require(error.what()[0] != '\0', "an error without a reason");
  }
}

}  // namespace omnimapper::fuzz
