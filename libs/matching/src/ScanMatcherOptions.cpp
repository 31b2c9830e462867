#include <omnimapper/matching/IcpMatcher.h>
#include <omnimapper/matching/PointToLineMatcher.h>
#include <omnimapper/matching/ScanMatcherOptions.h>

namespace omnimapper::matching {

const base::OptionTable<ScanMatcherOptions>& ScanMatcherOptions::table() {
  using Options = ScanMatcherOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice("matcher", &Options::matcher,
                  {{"point_to_line", MatcherKind::point_to_line}, {"icp", MatcherKind::icp}},
                  "Algorithm that matches scans: point-to-line matching, or MRPT's ICP (iterative closest points).")
          .number("max_distance_m", &Options::max_distance, base::Range::positive(),
                  "Largest distance between corresponding points in the first iterations.")
          .number("min_distance_m", &Options::min_distance, base::Range::positive(),
                  "The largest distance between corresponding points begins at max_distance_m and shrinks from "
                  "iteration to iteration, but not below this.")
          .integer("max_iterations", &Options::max_iterations, base::Range{1, 10000},
                   "Largest number of iterations of a match.")
          .choice("icp_method", &Options::icp_method,
                  {{"classic", IcpMethod::classic}, {"levenberg_marquardt", IcpMethod::levenberg_marquardt}},
                  "With matcher = icp, variant of MRPT's ICP.")
          .number("icp_max_angle_deg", &Options::icp_max_angle, base::Range{0, 45},
                  "With matcher = icp, this angle times a point's distance from the sensor is added to the largest "
                  "distance between corresponding points.")
          .integer("icp_decimation", &Options::icp_decimation, base::Range{1, 1000},
                   "With matcher = icp, only one in this many points is used for correspondences.");
  return table;
}

std::unique_ptr<ScanMatcher> makeMatcher(const ScanMatcherOptions& options) {
  if (options.matcher == MatcherKind::icp) return std::make_unique<IcpMatcher>(options);
  return std::make_unique<PointToLineMatcher>(options);
}

}  // namespace omnimapper::matching
