#pragma once

#include <omnimapper/draw/Image.h>

#include <string>

namespace omnimapper::draw {

/// The colour of landmarks with that label: walls brown, doors green, windows cyan, tables violet, cabinets ochre,
/// seats blue, floors slate, ceilings light blue, ramps pink, unclassified surfaces grey, and so on for all classes of
/// surfaces; any other label always gets the same one of four more colours.
Rgb colourOfLabel(const std::string& label);

/// Whether landmarks with that label lie over or under everything else, as floors and ceilings do, and would hide the
/// rest of a plan from above.
bool coversThePlan(const std::string& label);

}  // namespace omnimapper::draw
