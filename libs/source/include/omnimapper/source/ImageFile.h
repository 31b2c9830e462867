#pragma once

#include <optional>
#include <string>

namespace omnimapper::source {

/// Why a PNG or JPEG file must not be decoded: its header states more pixels than any camera has. A file of a few
/// kilobytes can state so, and a decoder allocates that memory first. None if the file may be decoded, and for files of
/// other kinds.
std::optional<std::string> whyTooLarge(const std::string& path);

/// Whether the end of a PNG or JPEG file is missing; a decoder would silently fill the rest with grey. It is missing in
/// whole images of some cameras, too.
bool isCutOff(const std::string& path);

}  // namespace omnimapper::source
