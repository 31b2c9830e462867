#pragma once

#include <mrpt/img/TColor.h>

#include <cstddef>

namespace omnimapper::obs {

/// The colour in which the thing of that index is drawn, wherever it is: neighbours are far apart.
mrpt::img::TColor indexColour(std::size_t index, std::uint8_t alpha = 255);

}  // namespace omnimapper::obs
