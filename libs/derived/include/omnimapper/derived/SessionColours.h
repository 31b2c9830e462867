#pragma once

#include <omnimapper/draw/Image.h>

namespace omnimapper::derived {

/// The colours of trajectories in pictures of a map: that of the newest session, and that of all earlier ones.
constexpr draw::Rgb kNewestSession{37, 99, 235}, kEarlierSessions{219, 39, 119};

}  // namespace omnimapper::derived
