#include <omnimapper/signs/TextReader.h>

#include <algorithm>

namespace omnimapper::signs {

namespace {

// Number of bytes of a letter that begins with this byte; 0 if no letter does.
std::size_t lengthOf(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

}  // namespace

std::vector<std::string> lettersOf(const std::string& text) {
  std::vector<std::string> letters;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = lengthOf(static_cast<unsigned char>(text[at]));
    const bool is_whole =
        length > 0 && at + length <= text.size() &&
        std::all_of(text.begin() + static_cast<std::ptrdiff_t>(at) + 1,
                    text.begin() + static_cast<std::ptrdiff_t>(at + length), [](char c) { return (c & 0xC0) == 0x80; });
    if (is_whole) letters.push_back(text.substr(at, length));
    at += is_whole ? length : 1;
  }
  return letters;
}

Alphabet::Alphabet(const std::string& letters) : letters_(lettersOf(letters)) {
  letters_.emplace_back(" ");
  std::sort(letters_.begin(), letters_.end());
}

std::string Alphabet::letterFor(const std::string& letter) const {
  const auto has = [this](const std::string& one) { return std::binary_search(letters_.begin(), letters_.end(), one); };
  if (has(letter)) return letter;
  const bool is_dot = letter == "\u00b7" || letter == "\u2022" || letter == "\u30fb" || letter == "\u2013" ||
                      letter == "\u2014" || letter == "\uff0d";
  return is_dot && has("-") ? "-" : "";
}

const char* Alphabet::common() {
  return "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-.,:/&'()";
}

}  // namespace omnimapper::signs
