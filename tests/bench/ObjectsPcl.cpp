// Objects in organized clouds by PCL, whose code is that of the thesis: planes with refinement, then Euclidean clusters
// of the points that are not on large planes.
#include <pcl/features/integral_image_normal.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/euclidean_cluster_comparator.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include "ObjectPeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZ;
using Normals = pcl::IntegralImageNormalEstimation<Point, pcl::Normal>;
using Comparator = pcl::EuclideanClusterComparator<Point, pcl::Label>;

struct Settings {
  Normals::NormalEstimationMethod method;
  double plane_distance;  // [m]
  std::size_t of_place;   // a plane with more points than that is removed
};

pcl::PointCloud<Point>::Ptr cloudOf(const source::PcdCloud& cloud) {
  auto points = pcl::make_shared<pcl::PointCloud<Point>>(static_cast<std::uint32_t>(cloud.width),
                                                         static_cast<std::uint32_t>(cloud.height));
  points->is_dense = false;
  for (std::size_t i = 0; i < cloud.z.size(); ++i) (*points)[i] = Point(cloud.x[i], cloud.y[i], cloud.z[i]);
  return points;
}

Objects objectsIn(const source::PcdCloud& cloud, const Settings& settings) {
  const auto points = cloudOf(cloud);
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  Normals estimate;
  estimate.setNormalEstimationMethod(settings.method);
  estimate.setMaxDepthChangeFactor(0.02F);
  estimate.setNormalSmoothingSize(20);
  estimate.setInputCloud(points);
  estimate.compute(*normals);

  pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(1000);
  segmentation.setAngularThreshold(3 * M_PI / 180);
  segmentation.setDistanceThreshold(settings.plane_distance);
  segmentation.setInputNormals(normals);
  segmentation.setInputCloud(points);
  std::vector<pcl::PlanarRegion<Point>, Eigen::aligned_allocator<pcl::PlanarRegion<Point>>> regions;
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers, of_labels, boundaries;
  auto labels = pcl::make_shared<pcl::PointCloud<pcl::Label>>();
  segmentation.segmentAndRefine(regions, coefficients, inliers, labels, of_labels, boundaries);

  // PCL 1.13 has the meaning reversed: the labels that it calls excluded are the only ones that it keeps.
  auto of_objects = pcl::make_shared<std::set<std::uint32_t>>();
  for (std::size_t i = 0; i < of_labels.size(); ++i) {
    if (of_labels[i].indices.size() <= settings.of_place) of_objects->insert(static_cast<std::uint32_t>(i));
  }
  auto comparator = pcl::make_shared<Comparator>();
  comparator->setInputCloud(points);
  comparator->setLabels(labels);
  comparator->setExcludeLabels(of_objects);
  comparator->setDistanceThreshold(0.01F, false);
  pcl::OrganizedConnectedComponentSegmentation<Point, pcl::Label> clustering(comparator);
  clustering.setInputCloud(points);
  std::vector<pcl::PointIndices> clusters;
  pcl::PointCloud<pcl::Label> cluster_labels;
  clustering.segment(cluster_labels, clusters);
  Objects found;
  for (const auto& cluster : clusters) {
    if (cluster.indices.size() >= 100) found.emplace_back(cluster.indices.begin(), cluster.indices.end());
  }
  return found;
}

}  // namespace

std::vector<ObjectPeer> pclObjects() {
  std::vector<ObjectPeer> peers;
  const auto add = [&](const std::string& name, const Settings& settings) {
    peers.push_back({name, [settings](const LabelledCloud& cloud) { return objectsIn(cloud.points, settings); }});
  };
  // The first two have thresholds as for the planes and in PCL's own example program. The others have the best of 64
  // sets that were tried on these clouds.
  add("PCL average 3D gradient, 2 cm, off planes of 10000 points", {Normals::AVERAGE_3D_GRADIENT, 0.02, 10000});
  add("PCL covariance normals, 2 cm, off planes of 10000 points", {Normals::COVARIANCE_MATRIX, 0.02, 10000});
  add("PCL average 3D gradient, 1 cm, off planes of 20000 points", {Normals::AVERAGE_3D_GRADIENT, 0.01, 20000});
  add("PCL covariance normals, 1 cm, off planes of 20000 points", {Normals::COVARIANCE_MATRIX, 0.01, 20000});
  return peers;
}

}  // namespace omnimapper::bench
