#pragma once

#include <omnimapper/motion/RelativeMotion.h>

namespace omnimapper::mapper {

using motion::RelativeMotion;

}  // namespace omnimapper::mapper
