// Objects by PCL's supervoxels, which are joined where they meet convexly (S. C. Stein et al., Object Partitioning
// using Local Convexity, CVPR 2014). Colours are not used, since neither our method nor PCL's chain uses them.
#include <pcl/point_types.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/supervoxel_clustering.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "ObjectPeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGBA;

pcl::PointCloud<Point>::Ptr cloudOf(const source::PcdCloud& cloud) {
  auto points = pcl::make_shared<pcl::PointCloud<Point>>(static_cast<std::uint32_t>(cloud.width),
                                                         static_cast<std::uint32_t>(cloud.height));
  points->is_dense = false;
  for (std::size_t i = 0; i < cloud.z.size(); ++i)
    (*points)[i].getVector3fMap() = Eigen::Vector3f(cloud.x[i], cloud.y[i], cloud.z[i]);
  return points;
}

// Whether a segment is a table, floor or wall: the method itself does not distinguish what objects stand on. Such a
// segment has as many points as the planes that PCL's chain removes in its better rows, and is flat to 1 cm (root mean
// square).
bool isPlace(const std::vector<int>& pixels, const source::PcdCloud& cloud) {
  constexpr std::size_t kFewest = 20000;
  constexpr double kFlat = 0.01;
  if (pixels.size() < kFewest) return false;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const int pixel : pixels) {
    const auto i = static_cast<std::size_t>(pixel);
    const Eigen::Vector3d point(cloud.x[i], cloud.y[i], cloud.z[i]);
    sum += point;
    squares += point * point.transpose();
  }
  const auto n = static_cast<double>(pixels.size());
  const Eigen::Matrix3d scatter = squares / n - (sum / n) * (sum / n).transpose();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()(0);
  return std::sqrt(std::max(0.0, least)) <= kFlat;
}

Objects objectsIn(const source::PcdCloud& cloud, bool extended) {
  // Weights and angles are those of PCL's own example program.
  pcl::SupervoxelClustering<Point> clustering(0.0075F, 0.03F);
  clustering.setInputCloud(cloudOf(cloud));
  clustering.setColorImportance(0);
  clustering.setSpatialImportance(1);
  clustering.setNormalImportance(4);
  std::map<std::uint32_t, pcl::Supervoxel<Point>::Ptr> supervoxels;
  clustering.extract(supervoxels);
  std::multimap<std::uint32_t, std::uint32_t> neighbours;
  clustering.getSupervoxelAdjacency(neighbours);

  pcl::LCCPSegmentation<Point> segmentation;
  segmentation.setConcavityToleranceThreshold(10);
  segmentation.setSmoothnessCheck(true, 0.0075F, 0.03F, 0.1F);
  segmentation.setKFactor(extended ? 1 : 0);
  segmentation.setInputSupervoxels(supervoxels, neighbours);
  segmentation.segment();
  const auto labelled = clustering.getLabeledCloud();
  segmentation.relabelCloud(*labelled);

  std::map<std::uint32_t, std::vector<int>> segments;
  for (std::size_t i = 0; i < labelled->size(); ++i)
    if (std::isfinite(cloud.z[i])) segments[(*labelled)[i].label].push_back(static_cast<int>(i));
  segments.erase(0);  // pixels without a supervoxel
  Objects found;
  for (auto& [label, pixels] : segments)
    if (pixels.size() >= 100 && !isPlace(pixels, cloud)) found.push_back(std::move(pixels));
  return found;
}

}  // namespace

std::vector<ObjectPeer> lccpObjects() {
  std::vector<ObjectPeer> peers;
  for (const bool extended : {false, true}) {
    peers.push_back({std::string("PCL supervoxels of 3 cm and LCCP") + (extended ? ", extended convexity" : ""),
                     [extended](const LabelledCloud& cloud) { return objectsIn(cloud.points, extended); }});
  }
  return peers;
}

}  // namespace omnimapper::bench
