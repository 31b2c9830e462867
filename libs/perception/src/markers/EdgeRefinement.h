#pragma once

#include <omnimapper/perception/ColourImage.h>
#include <omnimapper/perception/LensModel.h>

namespace omnimapper::perception::markers {

/// The corners of a black square on white, where the lines along its sides meet: on each side the place of the step
/// from black to white is measured across it at many places, by how much black there is. Gradients around a corner
/// (cv::cornerSubPix) put it 0.13 px too far inside a large marker, farther in a small one, which then seems farther
/// away; this does not. `picture` is grey; `corners` are right to 1.5 px; `cells`: how many, each as wide as the black
/// border, along a side. Where a side shows no step the corners remain as they are.
Corners refinedByEdges(const ColourImage& picture, const Corners& corners, int cells);

}  // namespace omnimapper::perception::markers
