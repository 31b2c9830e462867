#include <omnimapper/map/Level.h>

#include <cmath>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {
constexpr std::uint64_t kLastSource = static_cast<std::uint64_t>(Level::Source::imu);
}  // namespace

std::string Level::toBytes() const {
  ByteWriter out;
  out.uint(static_cast<std::uint64_t>(source), 1);
  for (int i = 0; i < 3; ++i) out.real(up[i]);
  for (int i = 0; i < 9; ++i) out.real(covariance(i / 3, i % 3));
  out.block(reason);
  return out.take();
}

Level Level::fromSection(const MapSection& section) {
  expectSection(section, kLayer, kLayerVersion);
  ByteReader in(section.bytes, placeOf(kLayer));
  Level level;
  const std::uint64_t source = in.uint(1);
  if (source > kLastSource) refuse(kLayer, "has an unknown source: the file is damaged");
  level.source = static_cast<Source>(source);
  for (int i = 0; i < 3; ++i) level.up[i] = in.real();
  for (int i = 0; i < 9; ++i) level.covariance(i / 3, i % 3) = in.real();
  level.reason = in.block();
  expectEnd(in, kLayer);
  constexpr double kOff = 1e-6;
  if (!level.up.allFinite() || !level.covariance.allFinite() || std::abs(level.up.norm() - 1) > kOff)
    refuse(kLayer, "its up direction is not a unit vector: the file is damaged");
  return level;
}

}  // namespace omnimapper::map
