#pragma once

#include <omnimapper/check/judge.h>

#include <vector>

namespace omnimapper::check {

/// Findings on sensors whose clocks differ.
std::vector<Finding> clockFindings(const LogFacts& facts);
/// Findings on images of another size than that of their calibration.
std::vector<Finding> imageSizeFindings(const LogFacts& facts);
/// Findings on depth cameras whose pose, calibration or clock the floor and the walls of a laser contradict.
std::vector<Finding> cameraFindings(const LogFacts& facts);

}  // namespace omnimapper::check
