#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/camera/LensModel.h>

#include <vector>

#include "ArucoMarkerExtractor.h"

namespace omnimapper::perception::markers {

struct FoundMarker {
  int id;
  camera::Corners corners;  ///< [px]
};

/// Finds the markers of the dictionary in a picture, in the order of their ids. Pictures that are not of 8 bits with 1
/// or 3 channels have none. Throws mrpt::img::CExceptionExternalImageNotFound.
std::vector<FoundMarker> findMarkers(const mrpt::img::CImage& picture, const ArucoMarkerOptions& options);

}  // namespace omnimapper::perception::markers
