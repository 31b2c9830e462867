#include "ScipCodec.h"

namespace omnimapper::players {

std::string encodeScip(std::uint32_t value, int characters) {
  std::string text;
  for (int i = characters - 1; i >= 0; --i) text += static_cast<char>(0x30 + (value >> (6 * i) & 0x3f));
  return text;
}

char scipSum(std::string_view line) {
  unsigned sum = 0;
  for (const char byte : line) sum += static_cast<unsigned char>(byte);
  return static_cast<char>(0x30 + (sum & 0x3f));
}

std::string withScipSum(std::string_view line) {
  return std::string(line) + scipSum(line) + "\n";
}

std::string scipInformation(std::string_view line) {
  return std::string(line) + ";" + scipSum(line) + "\n";
}

std::string scipBlock(std::string_view data) {
  std::string block;
  for (std::size_t begin = 0; begin < data.size(); begin += 64) block += withScipSum(data.substr(begin, 64));
  return block;
}

}  // namespace omnimapper::players
