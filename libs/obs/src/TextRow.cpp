#include "TextRow.h"

#include <cstdio>

namespace omnimapper::obs {

namespace {

std::string formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

TextRow& TextRow::field(const std::string& value) {
  if (!row_.empty()) row_ += ' ';
  row_ += value;
  return *this;
}

TextRow& TextRow::number(double value) {
  return field(formatted("%.17g", value));
}

TextRow& TextRow::whole(long long value) {
  return field(std::to_string(value));
}

TextRow& TextRow::text(const std::string& value) {
  std::string written;
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (code > ' ' && c != '%' && code != 127 && !(c == '-' && value.size() == 1)) {
      written += c;
    } else {
      char escaped[4];
      std::snprintf(escaped, sizeof escaped, "%%%02X", unsigned{code});
      written += escaped;
    }
  }
  return field(written.empty() ? "-" : written);
}

TextRow& TextRow::colour(const std::optional<Rgb>& value) {
  for (const int part : {value ? value->red : -1, value ? value->green : -1, value ? value->blue : -1}) whole(part);
  return *this;
}

TextRow& TextRow::polygon(const geometry::Polygon3& value) {
  whole(static_cast<long long>(value.vertices.size()));
  for (const auto& vertex : value.vertices) vector(vertex);
  return *this;
}

std::string shortly(double value) {
  return formatted("%.4g", value == 0 ? 0.0 : value);  // without the sign of -0
}

std::string inAscii(const std::string& text) {
  std::string ascii;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    unsigned code = length == 0 ? first : first & (0x7FU >> (length == 1 ? 0 : length));
    bool is_character = length > 0;
    for (std::size_t k = 1; k < length; ++k) {
      is_character = is_character && byte(i + k) >> 6 == 2;
      code = code << 6 | (byte(i + k) & 0x3F);
    }
    char escaped[16];
    if (!is_character) {
      std::snprintf(escaped, sizeof escaped, "\\x%02x", first);
    } else if (code >= 0x80) {
      std::snprintf(escaped, sizeof escaped, code > 0xFFFF ? "\\U%08x" : "\\u%04x", code);
    } else {
      std::snprintf(escaped, sizeof escaped, "%c", static_cast<char>(code));
    }
    ascii += escaped;
    i += is_character ? length : 1;
  }
  return ascii;
}

}  // namespace omnimapper::obs
