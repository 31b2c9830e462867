#pragma once

#include <omnimapper/building/SegmentationOptions.h>

#include <opencv2/core.hpp>
#include <vector>

#include "FreeSpace.h"

namespace omnimapper::building {

/// A straight piece of the border of free space, at measured obstacles [cells].
struct Face {
  cv::Point2d from, to;
  cv::Point2d inward;  ///< unit vector into the obstacle
  double length = 0;
};

std::vector<Face> facesOf(const FreeSpace& space, const SegmentationOptions& options);

/// A straight line of faces, which doors may interrupt [cells].
struct Wall {
  struct Part {
    double from = 0, to = 0;  ///< places on the line, from <= to
  };
  cv::Point2d origin, direction;
  std::vector<Part> parts;
  double length = 0;  ///< of all parts together

  cv::Point2d at(double place) const { return origin + direction * place; }
};

/// Joins faces that lie in one line to walls.
std::vector<Wall> wallsOf(std::vector<Face> faces, double cell, const SegmentationOptions& options);

}  // namespace omnimapper::building
