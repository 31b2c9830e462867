#pragma once

#include <omnimapper/source/LogLook.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace omnimapper::source {

/// Why a PNG or JPEG file must not be decoded: its header states more pixels than any camera has. A file of a few
/// kilobytes can state so, and a decoder allocates that memory first. None if the file may be decoded, and for files of
/// other kinds.
std::optional<std::string> whyTooLarge(const std::string& path);
/// The same for an image in memory.
std::optional<std::string> whyTooLargeImage(std::string_view bytes);

/// Width and height of an image [px].
struct ImageSize {
  std::uint64_t width = 0, height = 0;
};
/// The size that the header of a PNG or JPEG file states; none for a file of another kind or without such a header.
std::optional<ImageSize> imageSizeIn(const std::string& path);

/// Whether a file is a PNG with one channel of 16 bits, as depth images are.
bool isDeepGrey(const std::string& path);

/// Whether such a file is in a folder, of whose PNGs the first thousand are looked at.
bool holdsDeepGrey(const LogLook& look);

/// Whether the end of a PNG or JPEG file is missing; a decoder would silently fill the rest with grey. It is missing in
/// whole images of some cameras, too.
bool isCutOff(const std::string& path);

}  // namespace omnimapper::source
