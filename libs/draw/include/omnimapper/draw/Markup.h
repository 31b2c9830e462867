#pragma once

#include <string>
#include <string_view>

namespace omnimapper::draw {

/// Text as it may stand between the tags of HTML and SVG and in attributes; bytes that are no UTF-8 become question
/// marks, control characters go.
std::string escapeMarkup(std::string_view text);

std::string encodeBase64(std::string_view bytes);
/// The bytes of a PNG file as an address that stands for them, for pages and data that are one file.
std::string pngAddress(std::string_view bytes);

}  // namespace omnimapper::draw
