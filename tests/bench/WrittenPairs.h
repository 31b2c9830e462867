#pragma once

#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/eval/TumFile.h>

#include <filesystem>
#include <string>

#include "RawlogFrames.h"

namespace omnimapper::bench {

/// Writes every pixel that has a depth, row by row, as a binary PCD of x y z [m] in the optical frame.
inline void writePcd(const std::string& path, const RgbdFrame& frame) {
  std::vector<Eigen::Vector3f> points;
  const auto& c = frame.camera;
  std::size_t i = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++i) {
      if (frame.units[i] == 0) continue;
      const double z = frame.units[i] * frame.metres_per_unit;
      points.push_back(Eigen::Vector3d((x - c.cx) / c.fx * z, (y - c.cy) / c.fy * z, z).cast<float>());
    }
  }
  base::writeFile(path, [&](std::ostream& out) {
    const auto count = points.size();
    out << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << count
        << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << count << "\nDATA binary\n";
    out.write(reinterpret_cast<const char*>(points.data()),
              static_cast<std::streamsize>(count * sizeof(Eigen::Vector3f)));
  });
}

/// Writes the pairs for programs outside the project. Each pair whose true motion is known has <pair>_first.pcd,
/// <pair>_second.pcd, and first_from_second in truth.tum at a stamp that is the number of the pair. Images i - 1 and i
/// are a pair, for i = 1, 1 + `step`, ...
inline void writePairs(const std::string& folder, const PosedFrames& posed, std::size_t step) {
  std::filesystem::create_directories(folder);
  eval::Trajectory truth;
  for (std::size_t i = 1; i < posed.frames.size(); i += step) {
    if (!posed.poses[i - 1] || !posed.poses[i]) continue;
    const std::size_t pair = truth.size() + 1;
    const std::string name = folder + "/" + std::to_string(pair);
    writePcd(name + "_first.pcd", posed.frames[i - 1]);
    writePcd(name + "_second.pcd", posed.frames[i]);
    truth.push_back({base::stampFromUnix(static_cast<double>(pair)), inverse(*posed.poses[i - 1]) * *posed.poses[i]});
  }
  eval::writeTum(folder + "/truth.tum", truth);
}

}  // namespace omnimapper::bench
