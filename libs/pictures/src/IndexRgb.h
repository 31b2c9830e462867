#pragma once

#include <omnimapper/draw/Image.h>
#include <omnimapper/obs/IndexColour.h>

#include <cstddef>

namespace omnimapper::pictures {

/// The colour in which RawLogViewer draws the item with that index: obs::indexColour().
inline draw::Rgb indexRgb(std::size_t index) {
  const auto colour = obs::indexColour(index);
  return {colour.R, colour.G, colour.B};
}

}  // namespace omnimapper::pictures
