// PCL's version of the thesis's planes of one colour: normals, connected components that also compare colours, and
// refinement.
#include <pcl/features/integral_image_normal.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>
#include <pcl/segmentation/rgb_plane_coefficient_comparator.h>

#include "ComparatorPeers.h"
#include "PclClouds.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

std::vector<std::uint16_t> planes(const Cloud::Ptr& cloud, bool by_colour) {
  using Normals = pcl::IntegralImageNormalEstimation<Point, pcl::Normal>;
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  Normals estimate;
  estimate.setNormalEstimationMethod(Normals::COVARIANCE_MATRIX);
  estimate.setMaxDepthChangeFactor(0.02F);
  estimate.setNormalSmoothingSize(20);
  estimate.setInputCloud(cloud);
  estimate.compute(*normals);

  pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label> segmentation;
  if (by_colour) {
    auto comparator = pcl::make_shared<pcl::RGBPlaneCoefficientComparator<Point, pcl::Normal>>();
    comparator->setColorThreshold(30);
    segmentation.setComparator(comparator);
  }
  segmentation.setMinInliers(1000);
  segmentation.setAngularThreshold(3 * M_PI / 180);
  segmentation.setDistanceThreshold(0.02);
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PlanarRegion<Point>, Eigen::aligned_allocator<pcl::PlanarRegion<Point>>> regions;
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers, of_labels, boundaries;
  auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
  segmentation.segmentAndRefine(regions, coefficients, inliers, labels, of_labels, boundaries);

  std::vector<std::uint16_t> image(cloud->size(), 0);
  for (std::size_t k = 0; k < inliers.size(); ++k) {
    for (const int i : inliers[k].indices) image[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
  }
  return image;
}

ComparatorPeer peer(const std::string& name, bool by_colour) {
  auto cloud = std::make_shared<Cloud::Ptr>();
  return {name, [cloud](const RgbdFrame& frame) { *cloud = colouredCloud(frame); },
          [cloud, by_colour] { return planes(*cloud, by_colour); }};
}

}  // namespace

std::vector<ComparatorPeer> pclComparators() {
  return {peer("PCL PlaneCoefficientComparator", false), peer("PCL RGBPlaneCoefficientComparator", true)};
}

}  // namespace omnimapper::bench
