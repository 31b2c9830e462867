#pragma once

#include <omnimapper/derived/LandmarkShapes.h>
#include <omnimapper/plugin/View.h>

#include <string>
#include <vector>

namespace omnimapper::plugins {

/// A table of the landmarks: label, size, number of measurements and sensors, and the first and last time it was seen
/// [s] after `start`. If there are more than 200, those with the most measurements are listed. Empty without landmarks.
std::string drawLandmarkTable(const std::vector<derived::ShapedLandmark>& landmarks, base::Stamp start);
/// The number of landmarks that only one sensor measured, for each sensor, and of those that several did (thesis Fig.
/// 65).
std::string drawSensorBars(const std::vector<derived::ShapedLandmark>& landmarks);
/// The number of landmarks measured from each key frame, by kind of measurement (thesis Fig. 64).
std::string drawFeatureCurves(const mapper::View& view);

}  // namespace omnimapper::plugins
