#pragma once

#include <string>

namespace omnimapper::base {

/// A function exported by a library that is loaded only here, because loading is slow and few runs need it. `library`
/// (such as libomnimapper-window.so) is searched for only beside omnimapper's other libraries, and is never unloaded.
/// Throws Error(plugin_library) if it is missing or cannot be loaded: `what` says what then fails ("the live window
/// cannot be opened"), `remedy` what to do ("Install it, or leave out --gui.").
void* functionOfLibrary(const std::string& library, const char* function, const std::string& what,
                        const std::string& remedy);

}  // namespace omnimapper::base
