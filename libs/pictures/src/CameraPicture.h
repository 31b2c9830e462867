#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/draw/Image.h>

#include <optional>
#include <vector>

namespace omnimapper::pictures {

/// The image of a range camera with the derived observations drawn over it: planes filled in the colour of their index,
/// with outlines and normals; points and boxes of objects; points of clouds; markers with their numbers if the camera
/// is calibrated. The background is the colour image if it has the same view as the depth image, else the depth image
/// with near points bright.
draw::Image drawCameraPicture(const mrpt::obs::CObservation3DRangeScan& scan,
                              const std::vector<mrpt::obs::CObservation::Ptr>& derived);

/// The image of a camera with the markers that were found in it. None if it does not have 8 bits and 1 or 3 channels.
std::optional<draw::Image> drawCameraPicture(const mrpt::obs::CObservationImage& observation,
                                             const std::vector<mrpt::obs::CObservation::Ptr>& derived);

}  // namespace omnimapper::pictures
