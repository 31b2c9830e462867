#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>

namespace omnimapper::source {

/// Moves the images of an observation (colour and range) into files of an existing folder, colour as JPEG. The
/// observation then refers to them as MRPT's readers expect, relative to the folder. The names of the files begin with
/// base::asFileName(name). Thread-safe.
void moveImagesToFiles(mrpt::obs::CObservation& observation, const std::string& folder, const std::string& name);

/// For a log without external files: returns the observation itself if none of its data is in files, else a copy that
/// holds its images, depths and points. Data in files must have been loaded before, as sources do. Thread-safe.
mrpt::obs::CObservation::Ptr withImagesInside(const mrpt::obs::CObservation::Ptr& observation);

}  // namespace omnimapper::source
