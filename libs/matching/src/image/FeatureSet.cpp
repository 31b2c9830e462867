#include "image/FeatureSet.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>

namespace omnimapper::matching {

namespace {

// Mean inverse depth around a pixel; 0 where nothing was measured, and at a depth discontinuity, which looks different
// from another view.
double inverseDepthAround(const RgbdLevel& level, int x, int y) {
  constexpr float kOneSurface = 0.05F;  // largest relative difference on one surface
  if (x < 1 || y < 1 || x + 1 >= level.width || y + 1 >= level.height) return 0;
  float least = 1e9F, most = 0, sum = 0;
  int count = 0;
  for (int v = -1; v <= 1; ++v) {
    for (int u = -1; u <= 1; ++u) {
      const float one = level.inverse_depth[level.at(x + u, y + v)];
      if (!(one > 0)) continue;
      least = std::min(least, one);
      most = std::max(most, one);
      sum += one;
      ++count;
    }
  }
  constexpr int kFewest = 5;
  if (count < kFewest || most - least > kOneSurface * most) return 0;
  return static_cast<double>(sum) / count;
}

// Chooses the strongest corners of each part of the image, so that one bright poster does not take them all.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> all, int width, int height, int most) {
  constexpr int kColumns = 16, kRows = 12;
  const auto before = [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    if (a.response != b.response) return a.response > b.response;
    return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
  };
  std::sort(all.begin(), all.end(), before);
  std::array<std::vector<cv::KeyPoint>, kColumns * kRows> parts;
  for (const auto& key : all) {
    const int column = std::clamp(static_cast<int>(key.pt.x * kColumns / static_cast<float>(width)), 0, kColumns - 1);
    const int row = std::clamp(static_cast<int>(key.pt.y * kRows / static_cast<float>(height)), 0, kRows - 1);
    parts[static_cast<std::size_t>(row * kColumns + column)].push_back(key);
  }
  std::vector<cv::KeyPoint> chosen;
  for (std::size_t rank = 0; static_cast<int>(chosen.size()) < most; ++rank) {
    const std::size_t had = chosen.size();
    for (const auto& part : parts)
      if (rank < part.size() && static_cast<int>(chosen.size()) < most) chosen.push_back(part[rank]);
    if (chosen.size() == had) break;
  }
  return chosen;
}

}  // namespace

FeatureSet::FeatureSet(const RgbdPyramid& image, int most) {
  const auto& level = image.finest();
  camera = level.camera;
  if (!image.hasPicture()) return;
  const cv::Mat floats(level.height, level.width, CV_32FC1, const_cast<float*>(level.grey.data()));
  cv::Mat grey;
  floats.convertTo(grey, CV_8U);
  constexpr int kOfWhichSpread = 4, kLevels = 8, kEdge = 19, kFastThreshold = 8;
  constexpr float kScale = 1.2F;
  if (std::min(level.width, level.height) <= 2 * kEdge) return;  // no corner is so far from the edge
  const auto orb =
      cv::ORB::create(kOfWhichSpread * most, kScale, kLevels, kEdge, 0, 2, cv::ORB::HARRIS_SCORE, 31, kFastThreshold);
  std::vector<cv::KeyPoint> keys;
  orb->detect(grey, keys);
  const auto has_depth = [&](const cv::KeyPoint& key) {
    return inverseDepthAround(level, cvRound(key.pt.x), cvRound(key.pt.y)) > 0;
  };
  keys.erase(std::remove_if(keys.begin(), keys.end(), [&](const cv::KeyPoint& key) { return !has_depth(key); }),
             keys.end());
  keys = spread(std::move(keys), level.width, level.height, most);
  cv::Mat rows;
  orb->compute(grey, keys, rows);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const double u = static_cast<double>(keys[i].pt.x), v = static_cast<double>(keys[i].pt.y);
    const double inverse = inverseDepthAround(level, cvRound(u), cvRound(v));
    const Eigen::Vector3d ray((u - level.camera.cx) / level.camera.fx, (v - level.camera.cy) / level.camera.fy, 1);
    corners.push_back({{u, v, inverse}, ray / inverse, std::pow(static_cast<double>(kScale), keys[i].octave)});
    descriptors.emplace_back();
    std::memcpy(descriptors.back().data(), rows.ptr(static_cast<int>(i)), sizeof(Descriptor));
  }
}

}  // namespace omnimapper::matching
