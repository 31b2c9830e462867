#include "KnownPlanes.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>

namespace omnimapper::plugins {

PlanePayload KnownPlanes::emptyPayload() const {
  PlanePayload empty;
  empty.form = form_;
  return empty;
}

void KnownPlanes::restore(const mapper::State& state) {
  for (const auto id : state.candidates(owner_)) add(id);
}

void KnownPlanes::update(const mapper::View& view) {
  for (auto at = surfaces_.begin(); at != surfaces_.end();) {
    Surface& surface = at->second;
    const map::Landmark* landmark = view.map.landmarks.find(surface.id);
    if (!landmark || landmark->state != map::Landmark::State::active) {
      at = surfaces_.erase(at);
      continue;
    }
    ++at;
    if (surface.payload == landmark->payload.get() && surface.solve == view.solves.size() + 1) continue;
    const auto& payload = dynamic_cast<const PlanePayload&>(*landmark->payload);
    surface.variable = landmark->variables.front();
    surface.plane = form().plane(view.graph.value(surface.variable));
    const PlaneAxes axes(surface.plane);
    surface.hull = hullOn(axes, cornersInMap(payload.patches, view.map.key_frames));
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto& corner : surface.hull) middle += corner / static_cast<double>(surface.hull.size());
    surface.radius = 0;
    for (const auto& corner : surface.hull) surface.radius = std::max(surface.radius, (corner - middle).norm());
    surface.middle = axes.inSpace(middle);
    surface.last_seen_from = payload.last_seen_from;
    surface.payload = &payload;
    surface.solve = view.solves.size() + 1;
  }
}

double gapBetween(const KnownPlanes::Surface& surface, const std::vector<Eigen::Vector3d>& points_in_map) {
  return geometry::distance(surface.hull, hullOn(PlaneAxes(surface.plane), points_in_map));
}

}  // namespace omnimapper::plugins
