#pragma once

#include <mrpt/obs/CObservationPointCloud.h>
#include <omnimapper/matching/PlanarScan.h>

namespace omnimapper::plugins {

/// The cloud of a 2D scan in the plane of the base, lines fitted. Points that are not finite are left out.
matching::PlanarScan scanInBase(const mrpt::obs::CObservationPointCloud& cloud);

}  // namespace omnimapper::plugins
