#pragma once

#include <omnimapper/landmarks/LandmarkIndex.h>

#include <cstdint>

namespace omnimapper::plugins {

/// A point of the map, with the number that the sensor reports for it.
struct KnownPoint : landmarks::KnownLandmark {
  std::int32_t number = -1;  ///< -1: none

  void refresh(const map::Landmark& landmark, const mapper::View& view);
};

using PointLandmarkIndex = landmarks::LandmarkIndex<KnownPoint>;

}  // namespace omnimapper::plugins
