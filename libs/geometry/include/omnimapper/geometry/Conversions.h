#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include "omnimapper/geometry/Se3.h"

namespace omnimapper::geometry {

/// All conversions of poses and covariances between the conventions of MRPT, g2o and this project
/// (doc/architecture.md).

Se3 fromMrpt(const mrpt::poses::CPose3D& pose);
mrpt::poses::CPose3D toMrpt(const Se3& pose);
Se2 fromMrpt(const mrpt::math::TPose2D& pose);
Se2 fromMrpt(const mrpt::poses::CPose2D& pose);
mrpt::math::TPose2D toMrpt(const Se2& pose);

/// MRPT's covariance in a CPose3DPDFGaussian is that of the parameters x y z yaw pitch roll, with x y z along the axes
/// of the reference frame. Our covariance is in Se3's tangent at the mean.
Matrix6d covarianceFromMrpt(const mrpt::poses::CPose3D& mean, const Matrix6d& mrpt_cov);
/// Throws Error(internal) within 1e-6 of a pitch of +-90 deg, where MRPT's parameters have no derivative.
Matrix6d covarianceToMrpt(const mrpt::poses::CPose3D& mean, const Matrix6d& cov);

/// MRPT's covariance in a CPosePDFGaussian is that of x y yaw, with x y along the axes of the reference frame. Our
/// covariance is in Se2's tangent at the mean.
Eigen::Matrix3d covarianceFromMrpt(const mrpt::poses::CPose2D& mean, const Eigen::Matrix3d& mrpt_cov);
Eigen::Matrix3d covarianceToMrpt(const mrpt::poses::CPose2D& mean, const Eigen::Matrix3d& cov);

/// MRPT's Gaussian in our convention.
struct GaussianSe3 {
  Se3 mean;
  Matrix6d cov = Matrix6d::Zero();
};
GaussianSe3 fromMrpt(const mrpt::poses::CPose3DPDFGaussian& pdf);
/// Throws as covarianceToMrpt() does.
mrpt::poses::CPose3DPDFGaussian toMrpt(const GaussianSe3& gaussian);

struct GaussianSe2 {
  Se2 mean;
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();
};
GaussianSe2 fromMrpt(const mrpt::poses::CPosePDFGaussian& pdf);
mrpt::poses::CPosePDFGaussian toMrpt(const GaussianSe2& gaussian);

/// The information matrix (inverse covariance) of g2o's EDGE_SE3:QUAT is that of x y z and of the vector part of the
/// unit quaternion. To first order this vector part is half the rotation vector, so our rotation block is a quarter of
/// g2o's, and our mixed blocks are half of g2o's. The information of EDGE_SE2 is that of x y yaw, like ours, and needs
/// no conversion.
Matrix6d informationFromG2o(const Matrix6d& g2o_information);
Matrix6d informationToG2o(const Matrix6d& information);

}  // namespace omnimapper::geometry
