#pragma once

#include <omnimapper/draw/Image.h>

#include <string>

namespace omnimapper::exports {

/// The colour of what a user calls so: walls brown, tables violet, floors grey, ceilings light blue, slopes pink, and
/// every other name one of four more, always the same.
draw::Rgb colourOfLabel(const std::string& label);

/// Whether it lies over or under everything else, as floors and ceilings do: a plan from above would show nothing else.
bool coversThePlan(const std::string& label);

}  // namespace omnimapper::exports
