#pragma once

#include <optional>
#include <string>

namespace omnimapper::source {

/// Why a PNG or JPEG file is not to be decoded: by its header it has more pixels than any camera (a few kilobytes can
/// say so, and a decoder makes the room first), or its end is missing (a decoder fills the rest with grey and says
/// nothing). None for what may be, and for files of other kinds.
std::optional<std::string> whyNotToDecode(const std::string& path);

}  // namespace omnimapper::source
