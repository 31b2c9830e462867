#pragma once

namespace omnimapper::sim {

/// An object as an image shows it. Columns and rows of pixels count from 0.
struct ObjectView {
  int object = 0;                                ///< index in World::objects
  int pixels = 0;                                ///< number of pixels that show it, above 0; glass before it hides it
  int with_depth = 0;                            ///< number of these pixels that have a depth in the range image
  int left = 0, top = 0, right = 0, bottom = 0;  ///< first and last column and row of these pixels
  double distance = 0;                           ///< mean distance from the camera to their points [m]
};

}  // namespace omnimapper::sim
