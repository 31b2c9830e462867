#pragma once

#include <vector>

#include "Posture.h"

namespace omnimapper::sim {

/// The solids of a person with their tracks.
std::vector<Body> bodiesOf(const PersonSpec& spec, const Anatomy& anatomy, const std::vector<Posture>& postures);

}  // namespace omnimapper::sim
