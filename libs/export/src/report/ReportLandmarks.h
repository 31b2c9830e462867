#pragma once

#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

#include "plan/LandmarkShapes.h"

namespace omnimapper::exports {

/// What each landmark is, how large, how often and by which sensors it was seen, from when to when [s] after `start`.
/// Of more than 200, those seen most often. Empty without landmarks.
std::string drawLandmarkTable(const std::vector<ShapedLandmark>& landmarks, base::Stamp start);
/// How many landmarks each sensor saw alone, and how many several (thesis Fig. 65).
std::string drawSensorBars(const std::vector<ShapedLandmark>& landmarks);
/// How many landmarks each key frame measured, by kind of measurement (thesis Fig. 64).
std::string drawFeatureCurves(const mapper::View& view);

}  // namespace omnimapper::exports
