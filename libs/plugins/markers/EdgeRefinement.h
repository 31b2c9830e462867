#pragma once

#include <omnimapper/camera/ColourImage.h>
#include <omnimapper/camera/LensModel.h>

namespace omnimapper::perception::markers {

/// Refines the corners of a black square on white, which are where the lines along its sides meet. Each line is fitted
/// to the steps from black to white on many profiles across the side; the share of black on a profile gives the
/// position of its step. Gradients around a corner (cv::cornerSubPix) put it 0.13 px too far inside a large marker and
/// farther inside a small one, which then seems farther away; this method does not. `picture` is grey; `corners` are
/// accurate to 1.5 px; `cells`: number of cells along a side, each as wide as the black border. If a side shows no step
/// or a corner would move by 3 px or more, all corners are returned unchanged.
camera::Corners refinedByEdges(const camera::ColourImage& picture, const camera::Corners& corners, int cells);

}  // namespace omnimapper::perception::markers
