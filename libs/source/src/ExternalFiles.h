#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

namespace omnimapper::source {

/// Loads the data of an observation that is in external files: images, range images, clouds. Relative names are looked
/// up in `folder`. Returns the first file that cannot be read, if any. MRPT has one such folder for the whole process:
/// only this function sets it, under a lock, and it restores the old one.
std::optional<std::string> loadExternalFiles(const mrpt::obs::CObservation& observation, const std::string& folder);

/// Folder where MRPT's tools keep the external files of a rawlog: <rawlog without extension>_Images beside it, or
/// Images if only that exists.
std::string externalFolderOf(const std::string& rawlog);

}  // namespace omnimapper::source
