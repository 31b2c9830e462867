#pragma once

#include <omnimapper/source/LogLook.h>

#include <string>
#include <vector>

namespace omnimapper::source {

/// Name of the format that needs no registration: MRPT's rawlog.
inline const std::string kRawlog = "rawlog";

/// Names of the formats that recognize a log.
std::vector<std::string> recognizedFormats(const LogLook& look);

/// Names of all formats: rawlog, then those that are registered.
std::vector<std::string> knownFormats();

/// The names of all formats for a message, and which formats of the project are not available and why.
std::string formatsAsText();

}  // namespace omnimapper::source
