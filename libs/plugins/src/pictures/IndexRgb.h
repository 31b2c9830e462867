#pragma once

#include <omnimapper/obs/IndexColour.h>

#include <cstddef>

#include "../output/Image.h"

namespace omnimapper::plugins {

/// The colour in which RawLogViewer draws the thing with that index: obs::indexColour().
inline Rgb indexRgb(std::size_t index) {
  const auto colour = obs::indexColour(index);
  return {colour.R, colour.G, colour.B};
}

}  // namespace omnimapper::plugins
