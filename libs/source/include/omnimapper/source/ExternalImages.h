#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>

namespace omnimapper::source {

/// Moves the images of an observation (colour and range) into files of a folder that exists, colour as JPEG, and lets
/// the observation name them as MRPT's readers expect it: relative to the folder. What base::asFileName() makes of
/// `name` begins theirs. Thread-safe.
void moveImagesToFiles(mrpt::obs::CObservation& observation, const std::string& folder, const std::string& name);

/// For a log that is to stand alone: the observation itself if nothing of it is in a file, else a copy that holds its
/// images, depths and points. What is in files has been loaded, as a source hands it out. Thread-safe.
mrpt::obs::CObservation::Ptr withImagesInside(const mrpt::obs::CObservation::Ptr& observation);

}  // namespace omnimapper::source
