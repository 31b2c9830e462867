#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/poses/CPose3D.h>
#include <omnimapper/graph/FactorRecord.h>
#include <omnimapper/mapper/DecisionLog.h>
#include <omnimapper/mapper/PluginFactory.h>
#include <omnimapper/mapper/RelativeMotion.h>
#include <omnimapper/matching/ScanMatcher.h>
#include <omnimapper/plugins/LoopClosureOptions.h>

namespace omnimapper::plugins {

inline mrpt::math::TPose2D planar(const mrpt::poses::CPose3D& pose) {
  return {pose.x(), pose.y(), pose.yaw()};
}

/// A motion in the plane, covariance of x y yaw. Height and tilt stay open, as far as a spatial map asks for them.
mapper::RelativeMotion planarMotion(const mrpt::math::TPose2D& begin_from_end, const Eigen::Matrix3d& covariance);

/// The motion between two poses that a match measured. In a spatial map height and tilt stay open.
graph::FactorRecord scanFactor(const LoopClosureOptions& options, const mapper::PluginContext& context,
                               base::VariableId reference, base::VariableId scan, const matching::ScanMatch& match);

}  // namespace omnimapper::plugins
