#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// A 16-bit depth image and a colour image of the same view, which has three bytes a pixel: red, green, blue.
struct RgbdFrame {
  int width = 0, height = 0;
  double metres_per_unit = 1;
  camera::Pinhole camera;
  double stamp = 0, colour_stamp = 0;  ///< [s] Unix time
  std::vector<std::uint16_t> units;
  std::vector<std::uint8_t> rgb;
};

inline std::vector<std::string> filesOf(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The stamp [s] that is the name of a file.
inline double timeOf(const std::string& file) {
  return std::stod(std::filesystem::path(file).stem());
}

/// The file whose stamp is nearest to that of `to`.
inline std::string nearest(const std::vector<std::string>& files, const std::string& to) {
  return *std::min_element(files.begin(), files.end(), [&](const auto& a, const auto& b) {
    return std::abs(timeOf(a) - timeOf(to)) < std::abs(timeOf(b) - timeOf(to));
  });
}

/// Reads every `every`-th frame of a folder of the TUM RGB-D benchmark.
inline std::vector<RgbdFrame> readRgbd(const std::string& folder, int every, const camera::Pinhole& camera) {
  const auto depths = filesOf(folder + "/depth"), pictures = filesOf(folder + "/rgb");
  std::vector<RgbdFrame> frames;
  for (std::size_t i = 0; i < depths.size(); i += static_cast<std::size_t>(every)) {
    const cv::Mat depth = cv::imread(depths[i], cv::IMREAD_UNCHANGED);
    cv::Mat rgb;
    const std::string picture = nearest(pictures, depths[i]);
    cv::cvtColor(cv::imread(picture), rgb, cv::COLOR_BGR2RGB);
    if (depth.type() != CV_16U || depth.size() != rgb.size()) throw std::runtime_error("cannot use " + depths[i]);
    RgbdFrame frame{depth.cols, depth.rows, 1.0 / 5000, camera, timeOf(depths[i]), timeOf(picture), {}, {}};
    frame.units.assign(depth.begin<std::uint16_t>(), depth.end<std::uint16_t>());
    frame.rgb.assign(rgb.data, rgb.data + 3 * frame.units.size());
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace omnimapper::bench
