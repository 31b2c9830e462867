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
  return formatted("%.4g", value);
}

}  // namespace omnimapper::obs
