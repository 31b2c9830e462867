#include "FileMutation.h"

#include <omnimapper/testing/FramesBytes.h>
#include <zlib.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

namespace omnimapper::fuzz {

namespace {

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void changeLine(std::string& line, Dice& dice) {
  const auto equals = line.find('=');
  if (equals != std::string::npos) {
    const auto value = oddWord(dice);
    line = onceIn(dice, 8) ? value + line.substr(equals) : line.substr(0, equals + 1) + " " + value;
    return;
  }
  std::istringstream in(line);
  std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
  if (words.empty()) return;
  words[below(dice, words.size())] = oddWord(dice);
  line.clear();
  for (const auto& word : words) line += (line.empty() ? "" : " ") + word;
}

std::uint32_t bigEndian(const std::string& bytes, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[place + i]);
  return number;
}

void putBigEndian(std::string& bytes, std::size_t place, std::uint32_t number) {
  for (std::size_t i = 0; i < 4; ++i) bytes[place + i] = static_cast<char>(number >> (24 - 8 * i));
}

}  // namespace

std::string oddWord(Dice& dice) {
  const char* const words[] = {"",
                               "nan",
                               "inf",
                               "-1",
                               "0",
                               "1e300",
                               "-1e-300",
                               "1e999",
                               "9223372036854775808",
                               "0x10",
                               "1,5",
                               "true",
                               "yes please",
                               "../../../etc/passwd",
                               "/dev/zero",
                               "%n%s",
                               "\x1b[31m",
                               "none",
                               "NoMotionPlugin",
                               "a, b, , c",
                               "\xc3\x28"};
  const std::size_t word = below(dice, std::size(words) + 2);
  if (word == std::size(words)) return std::to_string(oddInstead(1, dice));
  if (word > std::size(words)) return std::string(70000, 'x');
  return words[word];
}

map::MapFile mutatedMap(const map::MapFile& map, const map::MapFile& other, Dice& dice) {
  auto sections = map.sections();
  const std::size_t count = 1 + below(dice, 4);
  for (std::size_t i = 0; i < count && !sections.empty(); ++i) {
    const std::size_t chosen = below(dice, sections.size());
    auto& section = sections[chosen];
    // A compressed section is sometimes damaged as it is, but mostly in its uncompressed content.
    const bool is_unpacked = section.name == "frames" && section.version == 3 && !onceIn(dice, 8);
    if (is_unpacked) {
      try {
        section.bytes = testing::unpackedFrames(section);
      } catch (const base::Error&) {
        continue;
      }
    }
    switch (below(dice, 16)) {
      case 0:
        sections.erase(sections.begin() + static_cast<std::ptrdiff_t>(chosen));
        continue;
      case 1:
        section.version = static_cast<std::uint32_t>(below(dice, 5));
        break;
      case 2:
        if (const auto* same = other.find(section.name)) section = *same;
        continue;
      case 3:
      case 4:
      case 5:
        damageBytes(section.bytes, dice);
        break;
      default:
        changeNumber(section.bytes, dice);
    }
    if (is_unpacked && section.bytes.size() > 4) section.bytes = testing::packedFrames(3, section.bytes).bytes;
  }
  map::MapFile mutated;
  for (auto& section : sections) mutated.set(std::move(section));
  return mutated;
}

std::string mutatedText(const std::string& text, Dice& dice) {
  auto lines = linesOf(text);
  const std::size_t count = 1 + below(dice, 4);
  for (std::size_t i = 0; i < count && !lines.empty(); ++i) {
    std::size_t chosen = below(dice, lines.size());
    // Comments are skipped, since changing them has no effect.
    for (std::size_t k = 0; k < lines.size() && (lines[chosen].empty() || lines[chosen][0] == ';'); ++k)
      chosen = (chosen + 1) % lines.size();
    const auto place = lines.begin() + static_cast<std::ptrdiff_t>(chosen);
    switch (below(dice, 8)) {
      case 0:
        lines.erase(place);
        break;
      case 1:
        lines.insert(place, lines[below(dice, lines.size())]);
        break;
      case 2:
        std::swap(lines[chosen], lines[below(dice, lines.size())]);
        break;
      case 3:
        damageBytes(lines[chosen], dice);
        break;
      default:
        changeLine(lines[chosen], dice);
    }
  }
  std::string mutated;
  for (const auto& line : lines) mutated += line + "\n";
  return mutated;
}

std::string mutatedPng(const std::string& png, Dice& dice) {
  constexpr std::size_t kSignature = 8, kHeader = 16;  // width and height follow the header
  std::string mutated = png;
  if (mutated.size() < kHeader + 13) return mutated;
  if (onceIn(dice, 2)) {
    const std::size_t place = kHeader + 4 * below(dice, 2);
    const double odd = oddInstead(bigEndian(mutated, place), dice);
    putBigEndian(mutated, place, static_cast<std::uint32_t>(odd >= 0 && odd < 4294967295.0 ? odd : 4294967295.0));
  }
  if (onceIn(dice, 4)) mutated[kHeader + 8 + below(dice, 5)] = static_cast<char>(below(dice, 20));
  if (onceIn(dice, 2)) damageBytes(mutated, dice);
  for (std::size_t place = kSignature; place + 12 <= mutated.size();) {
    const std::size_t size = bigEndian(mutated, place);
    if (size > mutated.size() - place - 12) break;
    const auto crc = crc32(0, reinterpret_cast<const Bytef*>(&mutated[place + 4]), static_cast<uInt>(size + 4));
    putBigEndian(mutated, place + 8 + size, static_cast<std::uint32_t>(crc));
    place += size + 12;
  }
  return mutated;
}

}  // namespace omnimapper::fuzz
