#include <omnimapper/base/Numbers.h>
#include <omnimapper/geometry/TumLine.h>

namespace omnimapper::geometry {

std::string tumLine(base::Stamp stamp, const Se3& world_from_body) {
  constexpr int kDecimals = 9;
  const double sign = world_from_body.rotation.w() < 0 ? -1 : 1;
  std::string line = base::formatUnix(stamp, 7);
  for (const double value : world_from_body.translation) line += " " + base::fixed(value, kDecimals);
  // Eigen stores x y z w, the order of the format.
  for (const double value : world_from_body.rotation.coeffs()) line += " " + base::fixed(sign * value, kDecimals);
  return line + "\n";
}

}  // namespace omnimapper::geometry
