#pragma once

namespace omnimapper::mapper {

/// How the base moves: SE(2) poses for a robot on a floor, SE(3) otherwise.
enum class Motion { planar, spatial };

}  // namespace omnimapper::mapper
