#pragma once

#include <string>
#include <string_view>

namespace omnimapper::base {

/// Functions for names that come from a log or a map (labels of sensors, classes, files). The content of such a name is
/// not trusted.

/// The text in a form that is safe to show on a terminal. Two kinds of bytes are written as escapes such as "\x1b", one
/// for each byte: bytes that are not UTF-8, and those of characters that would move the cursor, change colours, break
/// the line, change the writing direction or be invisible (control characters, U+200E, U+200F, U+2028 to U+202E, U+2066
/// to U+2069, U+FEFF). Applying the function to its own result changes nothing.
std::string printable(std::string_view text);

/// The label of a sensor in printable form. A text of more than 200 bytes is shortened to its beginning, the length of
/// the label, and a hash that distinguishes labels with the same beginning.
std::string sensorName(std::string_view label);

/// As printable(), for text of several lines: line breaks and tabs are kept.
std::string printableLines(std::string_view text);

/// Whether `key = text` in an INI is read back as `text`. If `text` has no blanks, it is then also read back as one
/// item of a list. False for text that would end or continue the line ("\"), begin a comment, separate items, be
/// trimmed or be expanded ("$").
bool fitsIni(std::string_view text);

/// A file name made from the text, without folders. Letters, digits, '-', '_' and '.' are kept; other characters become
/// '_'. The name is neither empty nor hidden.
std::string asFileName(std::string_view text);

}  // namespace omnimapper::base
