#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <limits>

namespace omnimapper::bench {

/// The organized cloud that PCL's methods take, made from a frame with units, metres_per_unit, width, height and
/// camera.
template <class Point, class Frame>
typename pcl::PointCloud<Point>::Ptr organizedCloud(const Frame& frame) {
  const auto width = static_cast<std::uint32_t>(frame.width), height = static_cast<std::uint32_t>(frame.height);
  auto cloud = pcl::make_shared<pcl::PointCloud<Point>>(width, height);
  cloud->is_dense = false;
  const auto& c = frame.camera;
  std::size_t i = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++i) {
      const auto z = frame.units[i] == 0 ? std::numeric_limits<float>::quiet_NaN()
                                         : static_cast<float>(frame.units[i] * frame.metres_per_unit);
      Point& point = (*cloud)[i];
      point.x = z * static_cast<float>((x - c.cx) / c.fx);
      point.y = z * static_cast<float>((y - c.cy) / c.fy);
      point.z = z;
    }
  }
  return cloud;
}

/// The same cloud with the colours of the frame's rgb.
template <class Frame>
pcl::PointCloud<pcl::PointXYZRGB>::Ptr colouredCloud(const Frame& frame) {
  auto cloud = organizedCloud<pcl::PointXYZRGB>(frame);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].r = frame.rgb[3 * i];
    (*cloud)[i].g = frame.rgb[3 * i + 1];
    (*cloud)[i].b = frame.rgb[3 * i + 2];
  }
  return cloud;
}

}  // namespace omnimapper::bench
