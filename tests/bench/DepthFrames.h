#pragma once

#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/sim/Sensor.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A depth image: depths along the optical axis [m], row by row; 0 where there is no measurement.
struct DepthFrame {
  int width = 640, height = 480;
  double focal = 525;  // [pixel]
  std::vector<float> depths;
  float at(int column, int row) const { return depths[static_cast<std::size_t>(row) * width + column]; }
};

/// Reads every `step`th depth image of a folder of the TUM RGB-D benchmark: 16 bits, 5000 units a metre.
inline std::vector<DepthFrame> readTum(const std::string& folder, int step) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/depth")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<DepthFrame> frames;
  for (std::size_t i = 0; i < files.size(); i += step) {
    mrpt::img::CImage image;
    if (!image.loadFromFile(files[i])) throw std::runtime_error("cannot read " + files[i]);
    DepthFrame frame;
    frame.focal = 517;
    frame.depths.resize(static_cast<std::size_t>(frame.width) * frame.height);
    for (int row = 0; row < frame.height; ++row) {
      const auto* line = image.ptrLine<std::uint16_t>(row);
      for (int column = 0; column < frame.width; ++column)
        frame.depths[static_cast<std::size_t>(row) * frame.width + column] = line[column] / 5000.0f;
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Decompresses LZF data. A control byte c below 32 is followed by c + 1 literal bytes. Any other one copies bytes of
/// the output: its upper three bits (plus the next byte if all three are set) are the length minus 2, its lower five
/// bits with the following byte are the distance back minus 1.
inline std::vector<char> unpackLzf(const std::vector<unsigned char>& packed, std::size_t size) {
  std::vector<char> out;
  out.reserve(size);
  for (std::size_t i = 0; i < packed.size();) {
    const unsigned control = packed[i++];
    if (control < 32) {
      for (unsigned n = 0; n <= control; ++n) out.push_back(static_cast<char>(packed.at(i++)));
      continue;
    }
    unsigned length = control >> 5;
    if (length == 7) length += packed.at(i++);
    const std::size_t back = ((control & 31u) << 8) + packed.at(i++) + 1;
    for (unsigned n = 0; n < length + 2; ++n) out.push_back(out.at(out.size() - back));
  }
  if (out.size() != size) throw std::runtime_error("LZF data does not have the stated size");
  return out;
}

/// Reads a cloud of 640 x 480 points of the object data set: compressed, with the fields label, x, y, z and rgba one
/// after the other.
inline DepthFrame readCloud(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  while (std::getline(file, line) && line.rfind("DATA", 0) != 0) {
  }
  std::uint32_t packed_size = 0, size = 0;
  file.read(reinterpret_cast<char*>(&packed_size), 4).read(reinterpret_cast<char*>(&size), 4);
  std::vector<unsigned char> packed(packed_size);
  file.read(reinterpret_cast<char*>(packed.data()), packed_size);
  if (!file) throw std::runtime_error("cannot read " + path);
  const std::vector<char> bytes = unpackLzf(packed, size);
  DepthFrame frame;
  const std::size_t count = static_cast<std::size_t>(frame.width) * frame.height;
  frame.depths.resize(count);
  std::memcpy(frame.depths.data(), bytes.data() + 3 * 4 * count, 4 * count);
  for (float& depth : frame.depths) depth = depth > 0 ? depth : 0;  // NaN becomes 0: no measurement
  return frame;
}

inline std::vector<DepthFrame> readClouds(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<DepthFrame> frames;
  for (const auto& path : files) frames.push_back(readCloud(path));
  return frames;
}

/// Frames 0, step, 2 step, ... of a simulated depth camera.
inline std::vector<DepthFrame> simulate(const sim::World& world, const sim::Track& map_from_base,
                                        const std::string& ini, int count) {
  const sim::Scenes scenes(world);
  sim::SensorContext context;
  context.duration = 30;
  context.world = &world;
  context.scenes = &scenes;
  context.map_from_base = &map_from_base;
  const auto sensor =
      sim::makeSensor(base::Config::fromText("[depth]\nclass = RgbdCamera\n" + ini, "bench"), "depth", context);
  std::vector<DepthFrame> frames;
  for (int i = 0; i < count; ++i) {
    const auto observation = sensor->measure(i * sensor->count() / count).observation;
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*observation);
    DepthFrame frame;
    frame.focal = scan.cameraParams.fx();
    for (int row = 0; row < frame.height; ++row) {
      for (int column = 0; column < frame.width; ++column)
        frame.depths.push_back(static_cast<float>(scan.rangeImage(row, column)) * scan.rangeUnits);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace omnimapper::bench
