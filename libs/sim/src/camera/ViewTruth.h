#pragma once

#include <omnimapper/sim/SignView.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace omnimapper::sim {

/// What a picture shows of the markers and signs of the world, for the record of truth:
/// {"markers": [{"corners", "distance_m", "incidence_deg", "visible", "name", "id"}],
///  "signs": [{..., "name", "room", "lines", "capitals_px", "least_capitals_px"}]}
/// as FaceView and SignView; `signs` are signsInView() of the same view.
nlohmann::ordered_json facesInView(const World& world, const Scenes& scenes, const Scene& scene, const CameraView& view,
                                   const std::vector<SignView>& signs);

/// [x, y, z, qx, qy, qz, qw], metres.
nlohmann::ordered_json poseJson(const geometry::Se3& pose);

}  // namespace omnimapper::sim
