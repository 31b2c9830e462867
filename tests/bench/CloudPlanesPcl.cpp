// Planes in unorganized clouds by PCL, as thesis 3.3 describes: RANSAC, clusters of the inliers, then again on the
// other points.
#include <pcl/ModelCoefficients.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <limits>
#include <memory>

#include "CloudPeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

struct Work {
  Cloud::Ptr cloud, voxels;
  pcl::VoxelGrid<Point> grid;
  std::vector<std::uint16_t> of_voxel;
};

// Stops after at most `rounds` rounds of RANSAC.
void findPlanes(Work& work, double tolerance, int min_points, int rounds) {
  work.of_voxel.assign(work.voxels->size(), 0);
  auto left = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < work.voxels->size(); ++i) left->push_back(static_cast<int>(i));
  pcl::SACSegmentation<Point> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setDistanceThreshold(tolerance);
  segmentation.setMaxIterations(500);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setInputCloud(work.voxels);
  std::uint16_t planes = 0;
  while (rounds-- > 0 && static_cast<int>(left->size()) >= min_points) {
    segmentation.setIndices(left);
    auto inliers = pcl::make_shared<pcl::PointIndices>();
    pcl::ModelCoefficients plane;
    segmentation.segment(*inliers, plane);
    if (static_cast<int>(inliers->indices.size()) < min_points) break;
    pcl::EuclideanClusterExtraction<Point> clustering;
    clustering.setClusterTolerance(0.1);
    clustering.setMinClusterSize(min_points);
    clustering.setInputCloud(work.voxels);
    clustering.setIndices(inliers);
    clustering.setSearchMethod(pcl::make_shared<pcl::search::KdTree<Point>>());
    std::vector<pcl::PointIndices> clusters;
    clustering.extract(clusters);
    for (const auto& cluster : clusters) {
      ++planes;
      for (const int i : cluster.indices) work.of_voxel[static_cast<std::size_t>(i)] = planes;
    }
    std::vector<bool> gone(work.voxels->size(), false);
    for (const int i : inliers->indices) gone[static_cast<std::size_t>(i)] = true;
    auto rest = pcl::make_shared<pcl::Indices>();
    for (const int i : *left) {
      if (!gone[static_cast<std::size_t>(i)]) rest->push_back(i);
    }
    left = rest;
  }
}

}  // namespace

std::vector<CloudPeer> pclCloudPlanes(double tolerance, int min_points) {
  auto work = std::make_shared<Work>();
  const auto take = [work](const std::vector<Eigen::Vector3f>& points) {
    work->cloud = pcl::make_shared<Cloud>();
    for (const auto& p : points) work->cloud->push_back(Point(p.x(), p.y(), p.z()));
    work->voxels = pcl::make_shared<Cloud>();
    work->grid.setLeafSize(0.025F, 0.025F, 0.025F);
    work->grid.setSaveLeafLayout(true);
    work->grid.setInputCloud(work->cloud);
    work->grid.filter(*work->voxels);
  };
  const auto labels = [work] {
    std::vector<std::uint16_t> of_point;
    for (const auto& p : *work->cloud) {
      const int voxel = work->grid.getCentroidIndex(p);
      of_point.push_back(voxel < 0 ? std::uint16_t{0} : work->of_voxel[static_cast<std::size_t>(voxel)]);
    }
    return of_point;
  };
  return {{"PCL VoxelGrid alone", take,
           [work] {
             Cloud voxels;
             work->grid.filter(voxels);
           },
           nullptr},
          {"PCL SACSegmentation and clusters, averaged before", take,
           [work, tolerance, min_points] { findPlanes(*work, tolerance, min_points, std::numeric_limits<int>::max()); },
           labels},
          {"PCL SACSegmentation and clusters, first plane only, averaged before", take,
           [work, tolerance, min_points] { findPlanes(*work, tolerance, min_points, 1); }, labels}};
}

}  // namespace omnimapper::bench
