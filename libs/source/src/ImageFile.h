#pragma once

#include <optional>
#include <string>

namespace omnimapper::source {

/// Why a PNG or JPEG file is not to be decoded: by its header it has more pixels than any camera. A few kilobytes can
/// say so, and a decoder makes the room first. None for what may be, and for files of other kinds.
std::optional<std::string> whyTooLarge(const std::string& path);

/// Whether the end of a PNG or JPEG file is missing: a decoder fills the rest with grey and says nothing. Of some
/// cameras whole images have no end either.
bool isCutOff(const std::string& path);

}  // namespace omnimapper::source
