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
  int first_surface, past;  // surface numbers of its body: from first_surface to before past
};

/// A camera that looks at a scene.
struct Eye {
  const Scenes& scenes;
  const Scene& scene;
  const CameraView& view;
};

/// How the camera sees a face; none if nothing of it is visible.
std::optional<FaceView> viewOf(const Eye& eye, const Face& face);

/// A body with the numbers of its surfaces: from first_surface to before past.
struct BodyAt {
  const Body* body;
  int first_surface, past;
};
std::map<std::string, BodyAt> bodiesByName(const World& world);

}  // namespace omnimapper::sim
