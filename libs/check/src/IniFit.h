#pragma once

#include <omnimapper/check/LogFacts.h>

#include <string>
#include <vector>

namespace omnimapper::check {

/// A kind of logs that an INI fits. The INI says so in its header, in a comment, whose further lines are indented:
///
///   ; Fits 9 (settings): odometry, CObservationPointCloud or CObservationVelodyneScan, no laser: planes of
///   ;   point clouds; needs --set planes.class=CloudPlaneExtractor
///
/// The number is the place of the INI in the list of those that fit a log. In brackets: `settings` if the INI maps this
/// only with settings that the last part names, `a guess` if the log does not show whether its sensors saw what the INI
/// maps. Then what the log must have, separated by commas: a laser or odometry that can be used, or observations of a
/// class; with "no", what it must not have. Last what the INI maps.
struct IniFit {
  struct Need {
    std::vector<std::string> one_of;
    bool is_absent = false;  ///< the log must have none of them
  };

  int place = 0;
  bool needs_settings = false, is_a_guess = false;
  std::vector<Need> needs;
  std::string what;

  /// Whether the log has what the INI needs.
  bool fits(const LogFacts& facts) const;
};

/// The kinds of logs that the header of an INI names; none for an INI that does not map. Throws Error(internal) for a
/// comment that begins with "; Fits" and has another form; `file` is for its message.
std::vector<IniFit> fitsOf(const std::string& ini, const std::string& file);

}  // namespace omnimapper::check
