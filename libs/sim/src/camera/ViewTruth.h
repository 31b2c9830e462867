#pragma once

#include <omnimapper/sim/SignView.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace omnimapper::sim {

/// The markers and signs of the world that a picture shows, for its line of truth:
/// {"markers": [{"corners", "distance_m", "incidence_deg", "visible", "name", "id"}],
///  "signs": [{..., "name", "room", "lines", "capitals_px", "least_capitals_px"}]}
/// with the values of FaceView and SignView. `signs` are those of signsInView() for the same view.
nlohmann::ordered_json facesInView(const World& world, const Scenes& scenes, const Scene& scene, const CameraView& view,
                                   const std::vector<SignView>& signs);

/// [x, y, z, qx, qy, qz, qw], metres.
nlohmann::ordered_json poseJson(const geometry::Se3& pose);

}  // namespace omnimapper::sim
