#include "back_end/judgeTilt.h"

#include <omnimapper/geometry/Angle.h>
#include <omnimapper/geometry/Conversions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace omnimapper::mapper {

std::optional<Evidence> judgeTilt(const map::Map& map) {
  constexpr double kTilt = 5 * geometry::kPi / 180;  // [rad] from one key frame to the next
  constexpr double kMuch = 10;                       // [%]
  std::size_t tilted = 0;
  double largest = 0;
  for (const auto& frame : map.key_frames) {
    const Eigen::Vector3d next_z = geometry::fromMrpt(frame.keyframe_from_next).rotation * Eigen::Vector3d::UnitZ();
    const double tilt = std::acos(std::clamp(next_z.z(), -1.0, 1.0));
    tilted += tilt > kTilt;
    largest = std::max(largest, tilt);
  }
  const double percent =
      map.key_frames.empty() ? 0 : 100.0 * static_cast<double>(tilted) / static_cast<double>(map.key_frames.size());
  if (percent <= kMuch) return std::nullopt;
  char text[300];
  std::snprintf(text, sizeof text,
                "the base tilts by more than 5 deg from one key frame to the next in %.0f %% of them (at most %.0f "
                "deg), which [mapper] motion = planar ignores; --check names the INI that fits; for a hand-held camera "
                "it is rgbd_handheld.ini",
                percent, largest * 180 / geometry::kPi);
  return Evidence{"tilted_percent", percent, Evidence::Says::against_it, text};
}

}  // namespace omnimapper::mapper
