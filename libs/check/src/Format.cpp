#include "Format.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace omnimapper::check {

std::string significant(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string fixed(double value, int decimals) {
  constexpr double kLarge = 1e7;  // beyond it all digits are noise
  if (std::abs(value) >= kLarge) return significant(value);
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string written = text;
  const bool is_zero = written.find_first_not_of("-0.") == std::string::npos;
  return is_zero && written[0] == '-' ? written.substr(1) : written;
}

std::string angleText(double radians) {
  constexpr double kHalfTurn = 179.95;  // -180 and 180 are the same angle
  const double value = degrees(radians);
  return fixed(value < -kHalfTurn ? value + 360 : value, 1);
}

std::string poseKeys(const mrpt::poses::CPose3D& pose) {
  return "pose_x_m " + fixed(pose.x(), 2) + ", pose_y_m " + fixed(pose.y(), 2) + ", pose_z_m " + fixed(pose.z(), 2) +
         ", pose_yaw_deg " + angleText(pose.yaw()) + ", pose_pitch_deg " + angleText(pose.pitch()) +
         ", pose_roll_deg " + angleText(pose.roll());
}

std::string percent(double share) {
  const double value = 100 * share;
  return fixed(value, (value > 0 && value < 1) || (value > 99 && value < 100) ? 1 : 0) + " %";
}

std::string quoted(const std::string& label) {
  return label.empty() ? "(no label)" : "'" + label + "'";
}

std::string sectionOf(const std::string& label) {
  std::string name = "place_of_" + label;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
  return name;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace omnimapper::check
