#include <omnimapper/plugins/ScanInBase.h>

#include <cmath>
#include <vector>

namespace omnimapper::plugins {

matching::PlanarScan scanInBase(const mrpt::obs::CObservationPointCloud& cloud) {
  std::vector<Eigen::Vector2f> points;
  points.reserve(cloud.pointcloud->size());
  const auto rotation = cloud.sensorPose.getRotationMatrix().asEigen();
  const double tx = cloud.sensorPose.x(), ty = cloud.sensorPose.y();
  for (std::size_t i = 0; i < cloud.pointcloud->size(); ++i) {
    float x, y, z;
    cloud.pointcloud->getPointFast(i, x, y, z);
    const double bx = tx + rotation(0, 0) * x + rotation(0, 1) * y + rotation(0, 2) * z;
    const double by = ty + rotation(1, 0) * x + rotation(1, 1) * y + rotation(1, 2) * z;
    if (std::isfinite(bx) && std::isfinite(by)) points.emplace_back(bx, by);
  }
  return matching::fitLines(points);
}

}  // namespace omnimapper::plugins
