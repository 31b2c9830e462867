#include <omnimapper/mapper/Fix.h>

#include <Eigen/Eigenvalues>

namespace omnimapper::mapper {

bool Fix::located() const {
  if (!joined || !covariance) return false;
  const Eigen::Matrix3d position = covariance->topLeftCorner<3, 3>();
  const double worst =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(position, Eigen::EigenvaluesOnly).eigenvalues()[2];
  return worst <= kLocatedSigma * kLocatedSigma;
}

}  // namespace omnimapper::mapper
