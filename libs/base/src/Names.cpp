#include <omnimapper/base/Names.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>

namespace omnimapper::base {

namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool is_valid = false;
};

// The first character of a text that is not empty. Bytes that are not UTF-8, or an overlong encoding, are returned as
// one invalid byte.
Character firstOf(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t bytes = lead >= 0xf0 && lead < 0xf8 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc0 || lead >= 0xf8 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7f >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeast[bytes] || code > 0x10ffff || is_surrogate) return {};
  return {code, bytes, true};
}

bool isShown(const Character& one) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) { return one.code >= first && one.code <= last; };
  if (!one.is_valid) return false;
  return !(within(0, 0x1f) || within(0x7f, 0x9f) || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
           within(0x2066, 0x2069) || one.code == 0xfeff);
}

std::string shown(std::string_view text, std::string_view also) {
  std::string result;
  while (!text.empty()) {
    const Character one = firstOf(text);
    for (const char c : text.substr(0, one.bytes)) {
      if (isShown(one) || also.find(c) != std::string_view::npos) {
        result += c;
        continue;
      }
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      result += escaped;
    }
    text.remove_prefix(one.bytes);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) {
  return shown(text, "");
}

std::string sensorName(std::string_view label) {
  constexpr std::size_t kLongest = 200, kBeginning = 120;
  std::string name = printable(label);
  if (name.size() <= kLongest) return name;
  // FNV-1a, which gives the same hash on every machine.
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : label) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  std::size_t end = kBeginning;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
  char rest[80];
  std::snprintf(rest, sizeof rest, "... (%zu bytes, %016llx)", label.size(), static_cast<unsigned long long>(hash));
  return name.substr(0, end) + rest;
}

std::string printableLines(std::string_view text) {
  return shown(text, "\n\t");
}

bool fitsIni(std::string_view text) {
  if (printable(text) != text || text.find_first_of(",$\\") != std::string_view::npos) return false;
  if (text.empty()) return true;
  if (text.front() == ' ' || text.back() == ' ') return false;
  for (const std::string_view comment : {";", "#", "//"}) {
    if (text.substr(0, comment.size()) == comment) return false;
    if (text.find(" " + std::string(comment)) != std::string_view::npos) return false;
  }
  return true;
}

std::string asFileName(std::string_view text) {
  std::string name(text);
  const auto is_odd = [](unsigned char c) {
    return !(std::isalnum(c) || c == '-' || c == '_' || c == '.') || c >= 0x80;
  };
  std::replace_if(name.begin(), name.end(), is_odd, '_');
  if (name.empty() || name.front() == '.') name.insert(0, "_");
  return name;
}

}  // namespace omnimapper::base
