#pragma once

#include <string>
#include <string_view>

namespace omnimapper::draw {

/// Text as it may stand between the tags of HTML and SVG and in attributes; bytes that are no UTF-8 become question
/// marks, control characters go.
std::string escapeMarkup(std::string_view text);

}  // namespace omnimapper::draw
