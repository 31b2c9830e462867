#pragma once

#include <pcl/features/integral_image_normal.h>
#include <pcl/features/organized_edge_detection.h>
#include <pcl/point_types.h>

namespace omnimapper::bench {

/// PCL's normals of an organized cloud, as its detector of high-curvature edges needs them.
template <class Point>
pcl::PointCloud<pcl::Normal>::Ptr pclNormals(const typename pcl::PointCloud<Point>::Ptr& cloud) {
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::IntegralImageNormalEstimation<Point, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.AVERAGE_3D_GRADIENT);
  estimation.setNormalSmoothingSize(10.0F);
  estimation.setBorderPolicy(estimation.BORDER_POLICY_MIRROR);
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);
  return normals;
}

/// The kinds of edges that each point is on, as bits, with the settings of the thesis. `threshold`: depth discontinuity
/// in parts of the depth.
template <class Detector, class CloudPtr>
pcl::PointCloud<pcl::Label> pclEdgeLabels(Detector& detector, const CloudPtr& cloud, int kinds,
                                          float threshold = 0.02F) {
  detector.setInputCloud(cloud);
  detector.setDepthDisconThreshold(threshold);
  detector.setMaxSearchNeighbors(50);
  detector.setEdgeType(kinds);
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> of_kinds;
  detector.compute(labels, of_kinds);
  return labels;
}

}  // namespace omnimapper::bench
