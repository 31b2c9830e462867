#pragma once

#include <string>

namespace omnimapper::program {

/// A folder that comes with the program, such as "ini" or "web": in `share/omnimapper` beside `bin`, or in the checkout
/// in which the program was built. Empty if the program's own path is unknown.
std::string shippedFolder(const std::string& name);

}  // namespace omnimapper::program
