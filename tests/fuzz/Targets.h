#pragma once

#include <omnimapper/base/Error.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>

namespace omnimapper::fuzz {

/// What is made of a fuzzer's bytes, whatever they are: the work is done or refused, and what comes out is sound. Each
/// throws where that is not so.
using Target = void (*)(const std::uint8_t* data, std::size_t size);

/// Depth images, with and without a picture, to everything that takes them.
void depthImages(const std::uint8_t* data, std::size_t size);
/// Observations of range cameras whose parts may contradict one another, to the extractors.
void rangeScans(const std::uint8_t* data, std::size_t size);
/// 2D scans to the extractors of lines, by both methods, and of points.
void laserScans(const std::uint8_t* data, std::size_t size);
/// Clouds without order, and Velodyne scans of made-up packets, to the finder of their planes.
void clouds(const std::uint8_t* data, std::size_t size);
/// Bytes of a log to the classes of `obs`.
void observations(const std::uint8_t* data, std::size_t size);
/// What comes over a network or a serial port: lines of odometry, and messages of a Hokuyo.
void sensorBytes(const std::uint8_t* data, std::size_t size);

/// By the names of their programs and of their folders in corpus/.
inline std::map<std::string, Target> targets() {
  return {{"depth_images", depthImages},  {"range_scans", rangeScans},  {"laser_scans", laserScans}, {"clouds", clouds},
          {"observations", observations}, {"sensor_bytes", sensorBytes}};
}

inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Runs what may refuse its input with an error that says why.
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
