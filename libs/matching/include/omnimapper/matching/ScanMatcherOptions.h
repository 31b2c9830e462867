#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/matching/ScanMatcher.h>

#include <memory>

namespace omnimapper::matching {

enum class MatcherKind { point_to_line, icp };
enum class IcpMethod { classic, levenberg_marquardt };

struct ScanMatcherOptions {
  MatcherKind matcher = MatcherKind::point_to_line;
  double max_distance = 1.5;  ///< [m] largest distance of a correspondence in the first iterations
  double min_distance = 0.1;  ///< [m] largest distance of a correspondence in the last iterations
  int max_iterations = 30;
  IcpMethod icp_method = IcpMethod::classic;
  /// [rad] The largest distance of a correspondence grows by this times the distance from the sensor.
  double icp_max_angle = 2.0 * base::option_text::kRadiansPerDegree;
  int icp_decimation = 3;  ///< every n-th point is paired

  static const base::OptionTable<ScanMatcherOptions>& table();
};

/// Makes the matcher that the options select.
std::unique_ptr<ScanMatcher> makeMatcher(const ScanMatcherOptions& options);

}  // namespace omnimapper::matching
