#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/perception/ArucoMarkerExtractor.h>
#include <omnimapper/perception/LensModel.h>

#include <vector>

namespace omnimapper::perception::markers {

struct FoundMarker {
  int id;
  Corners corners;  ///< [px]
};

/// The markers of the dictionary that a picture shows, in order of their ids. None in pictures that are not of 8 bits
/// with 1 or 3 channels. Throws mrpt::img::CExceptionExternalImageNotFound.
std::vector<FoundMarker> findMarkers(const mrpt::img::CImage& picture, const ArucoMarkerOptions& options);

}  // namespace omnimapper::perception::markers
