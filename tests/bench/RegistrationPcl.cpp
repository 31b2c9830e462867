// PCL's registration as the thesis used it: ICP of edges, of voxels and of all points, and GICP.
#include <pcl/filters/filter.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>

#include "PclClouds.h"
#include "PclEdges.h"
#include "RegistrationPeers.h"

namespace omnimapper::bench {

namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

template <class Detector>
Cloud::Ptr edgesBy(Detector& detector, const Cloud::Ptr& cloud, int kind) {
  const auto labels = pclEdgeLabels(detector, cloud, kind);
  auto edges = pcl::make_shared<Cloud>();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if ((labels[i].label & static_cast<unsigned>(kind)) != 0 && std::isfinite((*cloud)[i].z))
      edges->push_back((*cloud)[i]);
  }
  return edges;
}

Cloud::Ptr occluding(const Cloud::Ptr& cloud) {
  pcl::OrganizedEdgeBase<Point, pcl::Label> detector;
  return edgesBy(detector, cloud, 2);
}

Cloud::Ptr rgbEdges(const Cloud::Ptr& cloud) {
  pcl::OrganizedEdgeFromRGB<Point, pcl::Label> detector;
  return edgesBy(detector, cloud, 16);
}

Cloud::Ptr highCurvature(const Cloud::Ptr& cloud) {
  pcl::OrganizedEdgeFromNormals<Point, pcl::Normal, pcl::Label> detector;
  detector.setInputNormals(pclNormals<Point>(cloud));
  return edgesBy(detector, cloud, 8);
}

Cloud::Ptr points(const Cloud::Ptr& cloud) {
  auto finite = pcl::make_shared<Cloud>();
  std::vector<int> kept;
  pcl::removeNaNFromPointCloud(*cloud, *finite, kept);
  return finite;
}

Cloud::Ptr voxels(const Cloud::Ptr& cloud, float side) {
  pcl::VoxelGrid<Point> grid;
  grid.setInputCloud(points(cloud));
  grid.setLeafSize(side, side, side);
  auto sparse = pcl::make_shared<Cloud>();
  grid.filter(*sparse);
  return sparse;
}

// All rows have the same settings: correspondences up to 0.1 m, 50 iterations, epsilon 1e-4.
template <class Registration>
std::optional<Registered> align(Registration& registration, const Cloud::Ptr& first, const Cloud::Ptr& second,
                                const geometry::Se3& guess) {
  if (first->size() < 30 || second->size() < 30) return std::nullopt;
  registration.setInputTarget(first);
  registration.setInputSource(second);
  registration.setMaxCorrespondenceDistance(0.1);
  registration.setMaximumIterations(50);
  registration.setTransformationEpsilon(1e-8);  // PCL compares squares
  Eigen::Matrix4f start = Eigen::Matrix4f::Identity();
  start.topLeftCorner<3, 3>() = guess.rotation.toRotationMatrix().cast<float>();
  start.topRightCorner<3, 1>() = guess.translation.cast<float>();
  Cloud aligned;
  registration.align(aligned, start);
  if (!registration.hasConverged()) return std::nullopt;
  const Eigen::Matrix4d found = registration.getFinalTransformation().template cast<double>();
  const Eigen::Quaterniond rotation(Eigen::Matrix3d(found.topLeftCorner<3, 3>()));
  return Registered{{rotation.normalized(), found.topRightCorner<3, 1>()}, {}};
}

using Source = std::function<Cloud::Ptr(const Cloud::Ptr&)>;

template <class Registration>
RegistrationPeer peer(const std::string& name, const std::string& row, const Source& source, int every) {
  return {name, row, every, [source](const RgbdFrame& first, const RgbdFrame& second, const geometry::Se3& guess) {
            Registration registration;
            return align(registration, source(colouredCloud(first)), source(colouredCloud(second)), guess);
          }};
}

}  // namespace

std::vector<RegistrationPeer> pclRegistrations() {
  using Icp = pcl::IterativeClosestPoint<Point, Point>;
  using Gicp = pcl::GeneralizedIterativeClosestPoint<Point, Point>;
  const auto coarse = [](const Cloud::Ptr& cloud) { return voxels(cloud, 0.02F); };
  const auto fine = [](const Cloud::Ptr& cloud) { return voxels(cloud, 0.01F); };
  return {peer<Icp>("PCL ICP", "occluding edges", occluding, 1),
          peer<Icp>("PCL ICP", "RGB edges", rgbEdges, 2),
          peer<Icp>("PCL ICP", "high-curvature edges", highCurvature, 4),
          peer<Icp>("PCL ICP", "points, voxels of 2 cm", coarse, 8),
          peer<Gicp>("PCL GICP", "points, voxels of 2 cm", coarse, 8),
          peer<Icp>("PCL ICP", "points, voxels of 1 cm", fine, 32),
          peer<Gicp>("PCL GICP", "points, voxels of 1 cm", fine, 32),
          peer<Icp>("PCL ICP", "all points", points, 112),
          peer<Gicp>("PCL GICP", "all points", points, 112)};
}

}  // namespace omnimapper::bench
