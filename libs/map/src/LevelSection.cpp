#include <omnimapper/map/MapFile.h>

#include <cmath>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {
const std::string kLevelName = "level";
constexpr std::uint32_t kLevelVersion = 1;
constexpr std::uint64_t kLastSource = static_cast<std::uint64_t>(Level::Source::imu);
}  // namespace

MapSection levelToSection(const Level& level) {
  ByteWriter out;
  out.uint(static_cast<std::uint64_t>(level.source), 1);
  for (int i = 0; i < 3; ++i) out.real(level.up[i]);
  for (int i = 0; i < 9; ++i) out.real(level.covariance(i / 3, i % 3));
  out.block(level.reason);
  return {kLevelName, kLevelVersion, out.take()};
}

Level levelFromSection(const MapSection& section) {
  expectSection(section, kLevelName, kLevelVersion);
  ByteReader in(section.bytes, placeOf(kLevelName));
  Level level;
  const std::uint64_t source = in.uint(1);
  if (source > kLastSource) refuse(kLevelName, "has an unknown source: the file is damaged");
  level.source = static_cast<Level::Source>(source);
  for (int i = 0; i < 3; ++i) level.up[i] = in.real();
  for (int i = 0; i < 9; ++i) level.covariance(i / 3, i % 3) = in.real();
  level.reason = in.block();
  expectEnd(in, kLevelName);
  constexpr double kOff = 1e-6;
  if (!level.up.allFinite() || !level.covariance.allFinite() || std::abs(level.up.norm() - 1) > kOff)
    refuse(kLevelName, "its up direction is not a unit vector: the file is damaged");
  return level;
}

}  // namespace omnimapper::map
