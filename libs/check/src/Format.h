#pragma once

#include <mrpt/poses/CPose3D.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/base/OptionTable.h>

#include <cstddef>
#include <string>
#include <vector>

namespace omnimapper::check {

/// Fixed-point text such as "1.50", without "-0".
std::string fixed(double value, int decimals);
/// Text with three significant digits, such as "0.202" or "1.11e+30".
std::string significant(double value);
/// Text such as "37 %", or "0.4 %" where whole numbers would hide the share.
std::string percent(double share);
using base::counted;
/// Degrees with one decimal in (-180, 180].
std::string angleText(double radians);
/// The keys of a pose in a section of [mapper] sensors, all of them: "pose_x_m 0.20, ...".
std::string poseKeys(const mrpt::poses::CPose3D& pose);
/// The label in quotes, 'laser', or "(no label)".
std::string quoted(const std::string& label);
/// Name of a section for a sensor, made of its label: "place_of_laser".
std::string sectionOf(const std::string& label);
std::string joined(const std::vector<std::string>& words, const std::string& between);

inline double degrees(double radians) {
  return radians / base::option_text::kRadiansPerDegree;
}

}  // namespace omnimapper::check
