#pragma once

#include <string>

namespace omnimapper::base {

/// Loads a library and returns a function that the library exports. This is for libraries that few runs need, because
/// loading is slow. `library` (such as libomnimapper-live-scene.so) is searched for only beside omnimapper's other
/// libraries, and is never unloaded. Throws Error(plugin_library) if the library is missing or cannot be loaded. For
/// the message, `what` says what is not possible then ("the live window cannot be opened"), and `remedy` what to do
/// ("Install it, or leave out --gui.").
void* functionOfLibrary(const std::string& library, const char* function, const std::string& what,
                        const std::string& remedy);

}  // namespace omnimapper::base
