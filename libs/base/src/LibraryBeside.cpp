#include <dlfcn.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/LibraryBeside.h>

#include <filesystem>

namespace omnimapper::base {

namespace {

std::string pathBeside(const std::string& file) {
  Dl_info here;
  if (::dladdr(reinterpret_cast<const void*>(&pathBeside), &here) == 0) return file;
  return (std::filesystem::absolute(here.dli_fname).parent_path() / file).string();
}

}  // namespace

void* functionOfLibrary(const std::string& library, const char* function, const std::string& what,
                        const std::string& remedy) {
  void* const handle = ::dlopen(pathBeside(library).c_str(), RTLD_NOW);
  void* const found = handle ? ::dlsym(handle, function) : nullptr;
  if (!found)
    throw Error(ExitCode::plugin_library, what + ": " + ::dlerror() + ". " + library +
                                              " belongs beside the other libraries of OmniMapper. " + remedy);
  return found;
}

}  // namespace omnimapper::base
