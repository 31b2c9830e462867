#pragma once

#include <string>
#include <string_view>

namespace omnimapper::draw {

/// Escapes text for use between the tags of HTML and SVG and in attributes. Bytes that are not UTF-8 become question
/// marks. Control characters are removed, except line feeds and tabs.
std::string escapeMarkup(std::string_view text);

std::string encodeBase64(std::string_view bytes);
/// The bytes of a PNG file as a data URL, by which a page or drawing contains the picture itself.
std::string pngAddress(std::string_view bytes);

}  // namespace omnimapper::draw
