#pragma once

#include <omnimapper/sim/SignView.h>

#include <map>
#include <optional>
#include <string>

namespace omnimapper::sim {

/// A rectangle that faces its reader: x to the right, y up, z to the reader, origin in the middle.
struct Face {
  geometry::Se3 map_from_face;
  double width, height;     // [m]
  int first_surface, past;  // numbers of the surfaces of its body
};

/// Who looks.
struct Eye {
  const Scenes& scenes;
  const Scene& scene;
  const CameraView& view;
};

/// None if nothing of it is seen.
std::optional<FaceView> viewOf(const Eye& eye, const Face& face);

/// Bodies by name, with the numbers of their surfaces: from first_surface to before past.
struct BodyAt {
  const Body* body;
  int first_surface, past;
};
std::map<std::string, BodyAt> bodiesByName(const World& world);

}  // namespace omnimapper::sim
