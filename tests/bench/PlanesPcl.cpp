// Planes in organized clouds by PCL, whose code is that of the thesis: normals from integral images, connected
// components, refinement.
#include <pcl/features/integral_image_normal.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include "PclClouds.h"
#include "PlanePeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZ;
using Normals = pcl::IntegralImageNormalEstimation<Point, pcl::Normal>;

pcl::PointCloud<pcl::Normal>::Ptr normalsOf(const pcl::PointCloud<Point>::Ptr& cloud,
                                            Normals::NormalEstimationMethod method) {
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  Normals estimate;
  estimate.setNormalEstimationMethod(method);
  estimate.setMaxDepthChangeFactor(0.02F);
  estimate.setNormalSmoothingSize(20);
  estimate.setInputCloud(cloud);
  estimate.compute(*normals);
  return normals;
}

constexpr double kPclCurvature = 0.001,
                 kNoisyCurvature = 0.01;  // PCL's default, and a bound that passes a Kinect's noise

std::vector<std::uint16_t> planes(const DepthFrame& frame, Normals::NormalEstimationMethod method, bool refined,
                                  double max_curvature) {
  const auto cloud = organizedCloud<Point>(frame);
  pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(1000);
  segmentation.setAngularThreshold(3 * M_PI / 180);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setMaximumCurvature(max_curvature);
  segmentation.setInputNormals(normalsOf(cloud, method));
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PointIndices> inliers;
  std::vector<pcl::ModelCoefficients> coefficients;
  if (refined) {
    std::vector<pcl::PlanarRegion<Point>, Eigen::aligned_allocator<pcl::PlanarRegion<Point>>> regions;
    std::vector<pcl::PointIndices> of_labels, boundaries;
    auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
    segmentation.segmentAndRefine(regions, coefficients, inliers, labels, of_labels, boundaries);
  } else {
    segmentation.segment(coefficients, inliers);
  }

  std::vector<std::uint16_t> image(frame.units.size(), 0);
  for (std::size_t k = 0; k < inliers.size(); ++k) {
    for (const int i : inliers[k].indices) image[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
  }
  return image;
}

}  // namespace

std::vector<PlanePeer> pclPlanes() {
  std::vector<PlanePeer> peers;
  for (const auto& [name, method] : {std::pair{"PCL average 3D gradient", Normals::AVERAGE_3D_GRADIENT},
                                     std::pair{"PCL covariance normals", Normals::COVARIANCE_MATRIX}}) {
    peers.push_back({name + std::string(" alone"), [method = method](const DepthFrame& frame) {
                       normalsOf(organizedCloud<Point>(frame), method);
                       return std::vector<std::uint16_t>(frame.units.size(), 0);
                     }});
    const auto add = [&, method = method, name = name](bool refined, double curvature, const std::string& rest) {
      peers.push_back({std::string(name) + (refined ? " + planes + refinement" : " + planes") + rest,
                       [=](const DepthFrame& frame) { return planes(frame, method, refined, curvature); }});
    };
    add(false, kPclCurvature, "");
    add(true, kPclCurvature, "");
    add(true, kNoisyCurvature, ", curvature 0.01");
  }
  return peers;
}

}  // namespace omnimapper::bench
