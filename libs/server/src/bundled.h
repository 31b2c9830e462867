#pragma once

#include <map>
#include <string>

namespace omnimapper::server {

/// One classic script that does what the module `first` does; `modules` are the texts of modules by name. Each import
/// is a line `import { a, b } from './x.js';` or `import * as x from './x.js';`, and each export begins a line with
/// `export` before function, async function, class or const with one name or a list in brackets. Throws
/// Error(unreadable_input) if a module is missing, or two import each other.
std::string bundled(const std::map<std::string, std::string>& modules, const std::string& first);

}  // namespace omnimapper::server
