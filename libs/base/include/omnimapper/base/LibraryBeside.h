#pragma once

#include <string>

namespace omnimapper::base {

/// A function that a library exports, for which a program takes long to load and which few runs need. `library`
/// (such as libomnimapper-window.so) is searched for beside omnimapper's other libraries, in no other folder, and is
/// never unloaded. Throws Error(plugin_library) if it is not there or cannot be loaded: `what` says what fails then
/// ("the live window cannot be opened"), `remedy` what to do ("Install it, or leave out --gui.").
void* functionOfLibrary(const std::string& library, const char* function, const std::string& what,
                        const std::string& remedy);

}  // namespace omnimapper::base
