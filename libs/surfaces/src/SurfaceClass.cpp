#include "omnimapper/surfaces/SurfaceClass.h"

#include <algorithm>
#include <utility>

namespace omnimapper::surfaces {

namespace {

const std::vector<std::pair<SurfaceClass, const char*>>& names() {
  using Class = SurfaceClass;
  static const std::vector<std::pair<Class, const char*>> all{{Class::floor, "floor"},
                                                              {Class::ceiling, "ceiling"},
                                                              {Class::wall, "wall"},
                                                              {Class::door, "door"},
                                                              {Class::door_frame, "door frame"},
                                                              {Class::window, "window"},
                                                              {Class::table, "table"},
                                                              {Class::counter, "counter"},
                                                              {Class::shelf, "shelf"},
                                                              {Class::cabinet, "cabinet"},
                                                              {Class::seat, "seat"},
                                                              {Class::bed, "bed"},
                                                              {Class::appliance, "appliance"},
                                                              {Class::ramp, "ramp"},
                                                              {Class::poster, "poster"},
                                                              {Class::object, "object"},
                                                              {Class::surface, "surface"}};
  return all;
}

}  // namespace

std::string toString(SurfaceClass surface_class) {
  const auto& all = names();
  return std::find_if(all.begin(), all.end(), [&](const auto& named) { return named.first == surface_class; })->second;
}

std::optional<SurfaceClass> surfaceClassNamed(const std::string& name) {
  for (const auto& [surface_class, its_name] : names())
    if (its_name == name) return surface_class;
  return std::nullopt;
}

const std::vector<SurfaceClass>& allSurfaceClasses() {
  static const std::vector<SurfaceClass> all = [] {
    std::vector<SurfaceClass> classes;
    for (const auto& named : names()) classes.push_back(named.first);
    return classes;
  }();
  return all;
}

}  // namespace omnimapper::surfaces
