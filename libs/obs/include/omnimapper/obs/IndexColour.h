#pragma once

#include <mrpt/img/TColor.h>

#include <cstddef>

namespace omnimapper::obs {

/// The colour in which the item with that index is drawn everywhere. Colours of neighbouring indices differ clearly.
mrpt::img::TColor indexColour(std::size_t index, std::uint8_t alpha = 255);

}  // namespace omnimapper::obs
