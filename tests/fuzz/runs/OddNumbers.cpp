#include "OddNumbers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

namespace omnimapper::fuzz {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(),
                           kInfinity,
                           -kInfinity,
                           0,
                           -0.0,
                           -1,
                           1,
                           2,
                           1e-300,
                           1e-30,
                           -1e-9,
                           1e-3,
                           255,
                           65535,
                           1e6,
                           -1e6,
                           1e9,
                           2147483647,
                           -2147483648.0,
                           4294967295.0,
                           1e12,
                           1e38,
                           -1e38,
                           1e300,
                           -1e300};

// The bytes of an odd number of a random type.
std::string oddBytes(Dice& dice) {
  const double odd = kOdd[below(dice, std::size(kOdd))];
  std::string bytes;
  const auto append = [&](auto number) {
    bytes.resize(sizeof number);
    std::memcpy(bytes.data(), &number, sizeof number);
  };
  switch (below(dice, 4)) {
    case 0:
      append(odd);
      break;
    case 1:
      append(static_cast<float>(std::clamp(odd, -3e38, 3e38)));
      break;
    case 2:
      append(static_cast<std::int32_t>(std::isnan(odd) ? 0 : std::clamp(odd, -2147483648.0, 2147483647.0)));
      break;
    default:
      append(static_cast<std::uint16_t>(below(dice, 65536)));
      break;
  }
  return bytes;
}

}  // namespace

std::size_t below(Dice& dice, std::size_t end) {
  return end == 0 ? 0 : std::min(end - 1, static_cast<std::size_t>(dice.uniform(0, static_cast<double>(end))));
}

bool onceIn(Dice& dice, int times) {
  return dice.uniform(0, times) < 1;
}

double oddInstead(double number, Dice& dice) {
  switch (below(dice, 8)) {
    case 0:
      return number + dice.normal(0.01);
    case 1:
      return number + dice.normal(1);
    case 2:
      return number * dice.uniform(0, 3);
    case 3:
      return -number;
    case 4:
      return number * std::pow(10, dice.uniform(-9, 9));
    default:
      return kOdd[below(dice, std::size(kOdd))];
  }
}

void changeNumber(std::string& bytes, Dice& dice) {
  constexpr std::size_t kFarthest = 4096;
  const bool wants_count = onceIn(dice, 4);
  const std::size_t begin = below(dice, bytes.size());
  for (std::size_t place = begin; place + 8 <= bytes.size() && place < begin + kFarthest; ++place) {
    if (wants_count) {
      std::uint32_t count = 0;
      std::memcpy(&count, &bytes[place], sizeof count);
      if (count == 0 || count > 10000) continue;
      const double odd = oddInstead(count, dice);
      count = std::isnan(odd) ? 0 : static_cast<std::uint32_t>(std::clamp(odd, 0.0, 4294967295.0));
      std::memcpy(&bytes[place], &count, sizeof count);
      return;
    }
    double number = 0;
    std::memcpy(&number, &bytes[place], sizeof number);
    if (!(std::abs(number) > 1e-7 && std::abs(number) < 1e7)) continue;
    number = oddInstead(number, dice);
    std::memcpy(&bytes[place], &number, sizeof number);
    return;
  }
}

void damageBytes(std::string& bytes, Dice& dice) {
  if (bytes.empty()) return;
  const std::size_t place = below(dice, bytes.size());
  switch (below(dice, 5)) {
    case 0:
      bytes[place] = static_cast<char>(below(dice, 256));
      break;
    case 1:
      bytes.erase(place, 1 + below(dice, 16));
      break;
    case 2:
      bytes.insert(place, oddBytes(dice));
      break;
    case 3: {  // bytes from another place
      const std::size_t from = below(dice, bytes.size()), count = 1 + below(dice, 64);
      bytes.replace(place, count, bytes.substr(from, count));
      break;
    }
    default: {
      const auto odd = oddBytes(dice);
      bytes.replace(place, odd.size(), odd);
    }
  }
}

}  // namespace omnimapper::fuzz
