#pragma once

#include <nlohmann/json.hpp>

#include "Frame.h"

namespace omnimapper::sim {

/// What a picture shows of the markers and signs of the world, for the record of truth:
/// {"markers": [{"name", "id", "corners", "distance_m", "incidence_deg", "visible"}],
///  "signs": [{"name", "room", "lines", "corners", ...}]}
/// Corners in pixels, as the reader sees them: upper left, upper right, lower right, lower left; they may lie beside
/// the picture. `visible` is the part of the face that is in the picture and not hidden, above 0 in all that are
/// listed.
nlohmann::ordered_json facesInView(const World& world, const Scenes& scenes, const Scene& scene, const Pinhole& camera,
                                   const geometry::Se3& map_from_optical, double time);

/// [x, y, z, qx, qy, qz, qw], metres.
nlohmann::ordered_json poseJson(const geometry::Se3& pose);

}  // namespace omnimapper::sim
