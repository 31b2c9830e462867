// PCL's planes of organised clouds, the thesis's own: normals of integral images, connected components, refinement.
#include <pcl/features/integral_image_normal.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include "PlanePeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZ;
using Normals = pcl::IntegralImageNormalEstimation<Point, pcl::Normal>;

pcl::PointCloud<Point>::Ptr cloudOf(const DepthFrame& frame) {
  const auto width = static_cast<std::uint32_t>(frame.width), height = static_cast<std::uint32_t>(frame.height);
  auto cloud = pcl::make_shared<pcl::PointCloud<Point>>(width, height);
  cloud->is_dense = false;
  const perception::Pinhole& c = frame.camera;
  std::size_t i = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x, ++i) {
      const auto z = frame.units[i] == 0 ? std::numeric_limits<float>::quiet_NaN()
                                         : static_cast<float>(frame.units[i] * frame.metres_per_unit);
      (*cloud)[i] = Point(z * static_cast<float>((x - c.cx) / c.fx), z * static_cast<float>((y - c.cy) / c.fy), z);
    }
  }
  return cloud;
}

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

std::vector<std::uint16_t> planes(const DepthFrame& frame, Normals::NormalEstimationMethod method, bool refined) {
  const auto cloud = cloudOf(frame);
  pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(1000);
  segmentation.setAngularThreshold(3 * M_PI / 180);
  segmentation.setDistanceThreshold(0.02);
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
                       normalsOf(cloudOf(frame), method);
                       return std::vector<std::uint16_t>(frame.units.size(), 0);
                     }});
    for (const bool refined : {false, true}) {
      peers.push_back({name + std::string(refined ? " + planes + refinement" : " + planes"),
                       [method = method, refined](const DepthFrame& frame) { return planes(frame, method, refined); }});
    }
  }
  return peers;
}

}  // namespace omnimapper::bench
