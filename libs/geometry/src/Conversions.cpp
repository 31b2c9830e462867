#include "omnimapper/geometry/Conversions.h"

#include <omnimapper/base/Error.h>

namespace omnimapper::geometry {

namespace {

/// d(tangent) / d(x y z yaw pitch roll), for the rotation Rz(yaw) Ry(pitch) Rx(roll).
Matrix6d tangentFromMrptParameters(const mrpt::poses::CPose3D& mean) {
  const double sp = std::sin(mean.pitch()), cp = std::cos(mean.pitch());
  const double sr = std::sin(mean.roll()), cr = std::cos(mean.roll());
  Eigen::Matrix3d rates;  // rotation in the moved frame per unit of yaw, pitch, roll
  rates << -sp, 0, 1, cp * sr, cr, 0, cp * cr, -sr, 0;
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = fromMrpt(mean).rotation.toRotationMatrix().transpose();
  jacobian.bottomRightCorner<3, 3>() = rates;
  return jacobian;
}

Eigen::Matrix3d tangentFromMrptParameters(const mrpt::poses::CPose2D& mean) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() = fromMrpt(mean).rotation().transpose();
  return jacobian;
}

Matrix6d scaledRotation(const Matrix6d& information, double factor) {
  Vector6d scale = Vector6d::Ones();
  scale.tail<3>().setConstant(factor);
  return scale.asDiagonal() * information * scale.asDiagonal();
}

}  // namespace

Se3 fromMrpt(const mrpt::poses::CPose3D& pose) {
  const Eigen::Matrix3d rotation = pose.getRotationMatrix().asEigen();
  return {Eigen::Quaterniond(rotation).normalized(), {pose.x(), pose.y(), pose.z()}};
}

mrpt::poses::CPose3D toMrpt(const Se3& pose) {
  const mrpt::math::CMatrixDouble33 rotation(Eigen::Matrix3d(pose.rotation.toRotationMatrix()));
  mrpt::math::CMatrixDouble31 translation;
  for (int i = 0; i < 3; ++i) translation[i] = pose.translation[i];
  return mrpt::poses::CPose3D(rotation, translation);
}

Se2 fromMrpt(const mrpt::math::TPose2D& pose) {
  return {pose.x, pose.y, wrapToPi(pose.phi)};
}

Se2 fromMrpt(const mrpt::poses::CPose2D& pose) {
  return {pose.x(), pose.y(), wrapToPi(pose.phi())};
}

mrpt::math::TPose2D toMrpt(const Se2& pose) {
  return {pose.x, pose.y, pose.yaw};
}

Matrix6d covarianceFromMrpt(const mrpt::poses::CPose3D& mean, const Matrix6d& mrpt_cov) {
  const Matrix6d jacobian = tangentFromMrptParameters(mean);
  return jacobian * mrpt_cov * jacobian.transpose();
}

Matrix6d covarianceToMrpt(const mrpt::poses::CPose3D& mean, const Matrix6d& cov) {
  if (std::abs(std::cos(mean.pitch())) < 1e-6)
    throw base::Error(base::ExitCode::internal,
                      "covarianceToMrpt: pitch is 90 deg, where yaw and roll cannot be separated: keep this covariance "
                      "in Se3's tangent");
  const Matrix6d jacobian = tangentFromMrptParameters(mean).inverse();
  return jacobian * cov * jacobian.transpose();
}

Eigen::Matrix3d covarianceFromMrpt(const mrpt::poses::CPose2D& mean, const Eigen::Matrix3d& mrpt_cov) {
  const Eigen::Matrix3d jacobian = tangentFromMrptParameters(mean);
  return jacobian * mrpt_cov * jacobian.transpose();
}

Eigen::Matrix3d covarianceToMrpt(const mrpt::poses::CPose2D& mean, const Eigen::Matrix3d& cov) {
  const Eigen::Matrix3d jacobian = tangentFromMrptParameters(mean).transpose();
  return jacobian * cov * jacobian.transpose();
}

GaussianSe3 fromMrpt(const mrpt::poses::CPose3DPDFGaussian& pdf) {
  return {fromMrpt(pdf.mean), covarianceFromMrpt(pdf.mean, pdf.cov.asEigen())};
}

mrpt::poses::CPose3DPDFGaussian toMrpt(const GaussianSe3& gaussian) {
  mrpt::poses::CPose3DPDFGaussian pdf;
  pdf.mean = toMrpt(gaussian.mean);
  pdf.cov = mrpt::math::CMatrixDouble66(covarianceToMrpt(pdf.mean, gaussian.cov));
  return pdf;
}

GaussianSe2 fromMrpt(const mrpt::poses::CPosePDFGaussian& pdf) {
  return {fromMrpt(pdf.mean), covarianceFromMrpt(pdf.mean, pdf.cov.asEigen())};
}

mrpt::poses::CPosePDFGaussian toMrpt(const GaussianSe2& gaussian) {
  mrpt::poses::CPosePDFGaussian pdf;
  pdf.mean = mrpt::poses::CPose2D(toMrpt(gaussian.mean));
  pdf.cov = mrpt::math::CMatrixDouble33(covarianceToMrpt(pdf.mean, gaussian.cov));
  return pdf;
}

Matrix6d informationFromG2o(const Matrix6d& g2o_information) {
  return scaledRotation(g2o_information, 0.5);
}

Matrix6d informationToG2o(const Matrix6d& information) {
  return scaledRotation(information, 2);
}

}  // namespace omnimapper::geometry
