#include <omnimapper/geometry/SymmetricEigen.h>
#include <omnimapper/plugin/LocalizationEstimate.h>

namespace omnimapper::mapper {

std::optional<Eigen::Matrix3d> LocalizationEstimate::positionCovariance() const {
  if (!covariance) return std::nullopt;
  const Eigen::Matrix3d rotation = map_from_base.getRotationMatrix().asEigen();
  return rotation * covariance->topLeftCorner<3, 3>() * rotation.transpose();
}

bool LocalizationEstimate::located() const {
  const auto position = positionCovariance();
  if (!aligned || !position) return false;
  const Eigen::Matrix2d on_floor = position->topLeftCorner<2, 2>();
  const double worst = geometry::eigenvaluesOf<2>(on_floor)[1];
  return worst <= kLocatedSigma * kLocatedSigma;
}

}  // namespace omnimapper::mapper
