#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

namespace omnimapper::source {

/// Loads what the observation keeps in external files: images, range images, clouds. Relative names are looked up in
/// `folder`. Returns the first file that cannot be read. MRPT's folder for them is one for the whole process: this
/// function alone sets it, under a lock, and puts the old one back.
std::optional<std::string> loadExternalFiles(const mrpt::obs::CObservation& observation, const std::string& folder);

/// Where MRPT's tools keep the external files of a rawlog: <rawlog without extension>_Images beside it.
std::string externalFolderOf(const std::string& rawlog);

}  // namespace omnimapper::source
