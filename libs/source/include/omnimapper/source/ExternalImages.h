#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>

namespace omnimapper::source {

/// Moves the images of an observation (colour and range) into files of a folder that exists, colour as JPEG, and lets
/// the observation name them as MRPT's readers expect it: relative to the folder. `stem` begins their names.
/// Thread-safe.
void moveImagesToFiles(mrpt::obs::CObservation& observation, const std::string& folder, const std::string& stem);

}  // namespace omnimapper::source
