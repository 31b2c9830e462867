// PCL's edges of organised clouds, the thesis's own.
#include <pcl/features/integral_image_normal.h>
#include <pcl/features/organized_edge_detection.h>
#include <pcl/point_types.h>

#include <memory>

#include "EdgePeers.h"
#include "PclClouds.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;
using Normals = pcl::PointCloud<pcl::Normal>;

Normals::Ptr normalsOf(const Cloud::Ptr& cloud) {
  auto normals = pcl::make_shared<Normals>();
  pcl::IntegralImageNormalEstimation<Point, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.AVERAGE_3D_GRADIENT);
  estimation.setNormalSmoothingSize(10.0F);
  estimation.setBorderPolicy(estimation.BORDER_POLICY_MIRROR);
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);
  return normals;
}

template <class Detector>
std::vector<std::uint8_t> labelsOf(Detector& detector, const Cloud::Ptr& cloud, int kinds) {
  detector.setInputCloud(cloud);
  detector.setDepthDisconThreshold(0.02F);
  detector.setMaxSearchNeighbors(50);
  detector.setEdgeType(kinds);
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> of_kinds;
  detector.compute(labels, of_kinds);
  std::vector<std::uint8_t> image;
  image.reserve(labels.size());
  for (const pcl::Label& label : labels) image.push_back(static_cast<std::uint8_t>(label.label));
  return image;
}

template <class Run>
EdgePeer peer(const std::string& name, const Run& run) {
  auto cloud = std::make_shared<Cloud::Ptr>();
  return {name, [cloud](const RgbdFrame& frame) { *cloud = colouredCloud(frame); },
          [cloud, run] { return run(*cloud); }};
}

}  // namespace

std::vector<EdgePeer> pclEdges() {
  using pcl::Label;
  constexpr int kJumps = 1 + 2 + 4, kHighCurvature = 8, kRgb = 16;
  return {peer("PCL OrganizedEdgeBase: occluding, occluded, boundary",
               [](const Cloud::Ptr& cloud) {
                 pcl::OrganizedEdgeBase<Point, Label> detector;
                 return labelsOf(detector, cloud, kJumps);
               }),
          peer("PCL OrganizedEdgeFromNormals: high curvature, with normals",
               [](const Cloud::Ptr& cloud) {
                 pcl::OrganizedEdgeFromNormals<Point, pcl::Normal, Label> detector;
                 detector.setInputNormals(normalsOf(cloud));
                 return labelsOf(detector, cloud, kHighCurvature);
               }),
          peer("PCL OrganizedEdgeFromRGB: RGB",
               [](const Cloud::Ptr& cloud) {
                 pcl::OrganizedEdgeFromRGB<Point, Label> detector;
                 return labelsOf(detector, cloud, kRgb);
               }),
          peer("PCL OrganizedEdgeFromRGBNormals: all five, with normals", [](const Cloud::Ptr& cloud) {
            pcl::OrganizedEdgeFromRGBNormals<Point, pcl::Normal, Label> detector;
            detector.setInputNormals(normalsOf(cloud));
            return labelsOf(detector, cloud, kJumps + kHighCurvature + kRgb);
          })};
}

}  // namespace omnimapper::bench
