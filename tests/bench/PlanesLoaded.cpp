#include <dlfcn.h>

#include <stdexcept>

#include "PlanePeerLibrary.h"
#include "PlanePeers.h"

namespace omnimapper::bench {

namespace {

template <class Function>
Function* find(void* library, const char* name) {
  auto* function = reinterpret_cast<Function*>(dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(dlerror());
  return function;
}

}  // namespace

std::vector<PlanePeer> loadedPlanes(const std::string& library) {
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw std::runtime_error(dlerror());
  const int count = find<decltype(planePeerCount)>(handle, "planePeerCount")();
  auto* const name = find<decltype(planePeerName)>(handle, "planePeerName");
  auto* const run = find<decltype(planePeerRun)>(handle, "planePeerRun");
  std::vector<PlanePeer> peers;
  for (int peer = 0; peer < count; ++peer) {
    peers.push_back(
        {name(peer), [run, peer](const DepthFrame& frame) {
           const camera::Pinhole& c = frame.camera;
           const PlanePeerImage image{
               frame.units.data(), frame.width, frame.height, frame.metres_per_unit, c.fx, c.fy, c.cx, c.cy};
           std::vector<std::uint16_t> labels(frame.units.size(), 0);
           run(peer, &image, labels.data());
           return labels;
         }});
  }
  return peers;
}

}  // namespace omnimapper::bench
