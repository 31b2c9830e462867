// PCL's edges of organised clouds, the thesis's own.
#include <memory>

#include "EdgePeers.h"
#include "PclClouds.h"
#include "PclEdges.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

template <class Detector>
std::vector<std::uint8_t> labelsOf(Detector& detector, const Cloud::Ptr& cloud, int kinds) {
  const auto labels = pclEdgeLabels(detector, cloud, kinds);
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
                 detector.setInputNormals(pclNormals<Point>(cloud));
                 return labelsOf(detector, cloud, kHighCurvature);
               }),
          peer("PCL OrganizedEdgeFromRGB: RGB",
               [](const Cloud::Ptr& cloud) {
                 pcl::OrganizedEdgeFromRGB<Point, Label> detector;
                 return labelsOf(detector, cloud, kRgb);
               }),
          peer("PCL OrganizedEdgeFromRGBNormals: all five, with normals", [](const Cloud::Ptr& cloud) {
            pcl::OrganizedEdgeFromRGBNormals<Point, pcl::Normal, Label> detector;
            detector.setInputNormals(pclNormals<Point>(cloud));
            return labelsOf(detector, cloud, kJumps + kHighCurvature + kRgb);
          })};
}

}  // namespace omnimapper::bench
