#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/draw/Image.h>

#include <optional>
#include <vector>

namespace omnimapper::exports {

/// What a range camera saw, with what was derived of it drawn over: planes filled in the colour of their index,
/// outlined and with their normals; the points of objects, and their boxes; the points of clouds; markers with their
/// numbers, where the camera is calibrated. Over the colour image where it is of the same view as the depth, else over
/// the depth, near bright.
draw::Image drawCameraPicture(const mrpt::obs::CObservation3DRangeScan& scan,
                              const std::vector<mrpt::obs::CObservation::Ptr>& derived);

/// The picture of a camera, with the markers that were found in it. None for a picture that is not of 8 bits with 1 or
/// 3 channels.
std::optional<draw::Image> drawCameraPicture(const mrpt::obs::CObservationImage& observation,
                                             const std::vector<mrpt::obs::CObservation::Ptr>& derived);

}  // namespace omnimapper::exports
