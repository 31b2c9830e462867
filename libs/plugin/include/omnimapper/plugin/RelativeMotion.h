#pragma once

#include <omnimapper/matching/RelativeMotion.h>

namespace omnimapper::mapper {

using matching::RelativeMotion;

}  // namespace omnimapper::mapper
