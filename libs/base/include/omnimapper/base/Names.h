#pragma once

#include <string>
#include <string_view>

namespace omnimapper::base {

/// Functions for names that come from a log or a map (labels of sensors, classes, files). Their content is not trusted.

/// The text in a form that is safe to show on a terminal. Characters that would move the cursor, change colours, break
/// the line or change the writing direction (control characters, U+2028, U+2029, U+200E, U+200F, U+202A to U+202E,
/// U+2066 to U+2069) and bytes that are not UTF-8 are written as "\x1b", one escape for each byte. Applying the
/// function twice changes nothing more.
std::string printable(std::string_view text);

/// The label of a sensor in printable form. If it has more than 200 bytes, it is shortened to its beginning, its length
/// and a hash that distinguishes labels with the same beginning.
std::string sensorName(std::string_view label);

/// As printable(), for text of several lines: line breaks and tabs are kept.
std::string printableLines(std::string_view text);

/// Whether `key = text` in an INI is read back as `text`, and also, if it has no blank, as an item of a list. Not so
/// for text that ends or continues the line ("\"), begins a comment, separates items, is trimmed or is expanded ("$").
bool fitsIni(std::string_view text);

/// A file name made from the text, without folders: letters, digits, '-', '_' and '.' are kept, other characters become
/// '_'; it is neither empty nor hidden.
std::string asFileName(std::string_view text);

}  // namespace omnimapper::base
