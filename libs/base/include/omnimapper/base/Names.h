#pragma once

#include <string>
#include <string_view>

namespace omnimapper::base {

/// Names that come from a log or a map (labels of sensors, classes, files) are data: whoever made the log chose them.

/// The text as it may be shown on a terminal: what would move the cursor, change colours, break the line or turn the
/// direction of writing (control characters, U+2028, U+2029, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069) and
/// bytes that are no UTF-8 stand as "\x1b", one for each byte. The same text is changed once: what is printable stays
/// as it is.
std::string printable(std::string_view text);

/// The name of a sensor as a log gives it, printable; of one with more than 200 bytes the beginning, its length and a
/// number that tells it from others that begin alike.
std::string sensorName(std::string_view label);

/// printable() for several lines, which stay several: '\n' and '\t' are left.
std::string printableLines(std::string_view text);

/// Whether `key = text` in an INI is read back as `text`, and without a blank as the item of a list, too: nothing that
/// ends the line or carries it on ("\"), begins a comment, parts items, is trimmed or is expanded ("$").
bool fitsIni(std::string_view text);

/// A file's name made of it, in one folder: letters, digits, '-', '_' and '.' stay, others become '_'; it is neither
/// empty nor hidden.
std::string asFileName(std::string_view text);

}  // namespace omnimapper::base
