#pragma once

#include <omnimapper/draw/Image.h>

#include <string>

namespace omnimapper::exports {

/// The colour of what a user calls so: walls brown, doors green, windows cyan, tables violet, cabinets ochre, seats
/// blue, floors slate, ceilings light blue, ramps pink, what nobody can name grey, and so on for all classes of
/// surfaces; every other name has one of four more, always the same.
draw::Rgb colourOfLabel(const std::string& label);

/// Whether it lies over or under everything else, as floors and ceilings do: a plan from above would show nothing else.
bool coversThePlan(const std::string& label);

}  // namespace omnimapper::exports
