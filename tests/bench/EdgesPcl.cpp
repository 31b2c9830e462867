// Edges in organized clouds by PCL, whose code is that of the thesis.
#include <memory>

#include "EdgePeers.h"
#include "PclClouds.h"
#include "PclEdges.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

constexpr int kDepthEdges = 1 + 2 + 4, kHighCurvature = 8, kRgb = 16;

template <class Detector>
std::vector<std::uint8_t> labelsOf(Detector& detector, const Cloud::Ptr& cloud, int kinds, float threshold = 0.02F) {
  const auto labels = pclEdgeLabels(detector, cloud, kinds, threshold);
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

EdgePeer depthEdgesOf(const std::string& name, float threshold) {
  return peer(name, [threshold](const Cloud::Ptr& cloud) {
    pcl::OrganizedEdgeBase<Point, pcl::Label> detector;
    return labelsOf(detector, cloud, kDepthEdges, threshold);
  });
}

EdgePeer allOf(const std::string& name, float threshold) {
  return peer(name, [threshold](const Cloud::Ptr& cloud) {
    pcl::OrganizedEdgeFromRGBNormals<Point, pcl::Normal, pcl::Label> detector;
    detector.setInputNormals(pclNormals<Point>(cloud));
    return labelsOf(detector, cloud, kDepthEdges + kHighCurvature + kRgb, threshold);
  });
}

}  // namespace

std::vector<EdgePeer> pclEdges() {
  using pcl::Label;
  return {depthEdgesOf("PCL OrganizedEdgeBase: occluding, occluded, boundary", 0.02F),
          depthEdgesOf("PCL OrganizedEdgeBase: the same, depth threshold 0.03", 0.03F),
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
          allOf("PCL OrganizedEdgeFromRGBNormals: all five, with normals", 0.02F)};
}

std::vector<EdgePeer> pclEdgesOfAllKinds() {
  return {allOf("PCL, depth threshold 0.02", 0.02F), allOf("PCL, depth threshold 0.03", 0.03F)};
}

}  // namespace omnimapper::bench
