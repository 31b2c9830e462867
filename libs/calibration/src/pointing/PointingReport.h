#pragma once

#include <omnimapper/interaction/fitPointing.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace omnimapper::calibration {

/// The tables for people to read, with what is known of each mean.
std::string pointingReport(const interaction::PointingFit& fit, std::size_t frames, const std::string& title);

/// What a user should know: targets with few people, or with frames that hardly differ.
std::vector<std::string> pointingWarnings(const interaction::PointingFit& fit);

/// Draws the errors of both rays, a dot for each frame and a colour for each person, as Figures 92 and 93 of the
/// thesis.
void drawPointing(const std::vector<interaction::PointingSample>& samples, std::ostream& out);

}  // namespace omnimapper::calibration
