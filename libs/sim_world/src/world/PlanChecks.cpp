#include "PlanChecks.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim_world/Materials.h>

#include <set>

namespace omnimapper::sim {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Largest distance from the map's origin along x and y, where single precision resolves a millimetre [m].
constexpr double kFarthest = 1e4;

}  // namespace

void refuseUnknownMaterial(const WorldPlan& plan, const std::string& section, const std::string& key,
                           const std::string& name) {
  if (findMaterial(name)) return;
  refuse(plan, section, key, sayUnknownMaterial(name));
}

void refuseTwins(const WorldPlan& plan) {
  std::set<std::string> names{"outside"};
  const auto check = [&](const auto& list) {
    for (const auto& item : list) {
      if (!names.insert(item.name).second)
        refuse(plan, item.name, "name", "two sections have this name; give this one another name");
    }
  };
  check(plan.rooms);
  check(plan.openings);
  check(plan.furniture);
  check(plan.objects);
  check(plan.signs);
  check(plan.posters);
  check(plan.markers);
  check(plan.landmarks);
  check(plan.people);
  check(plan.companions);
}

void refuseHugePlaces(const WorldPlan& plan) {
  Vector2d low = Vector2d::Constant(kFarthest), high = -low;
  for (const RoomPlan& room : plan.rooms) {
    for (const Vector2d& corner : room.outline) {
      if (!(corner.cwiseAbs().maxCoeff() <= kFarthest))
        refuse(plan, room.name, "outline_m", "is farther than " + base::brief(kFarthest, 5) + " m from the origin");
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const Vector2d size = (high - low).cwiseMax(0);
    if (size.prod() <= kLargestPlace) continue;
    refuse(plan, room.name, "outline_m",
           "the place is " + base::brief(size.x()) + " x " + base::brief(size.y()) + " m with it; at most " +
               base::fixed(kLargestPlace, 0) + " m^2 are possible");
  }
}

Vector3d reachOf(const Body& body) {
  Vector3d reach = Vector3d::Zero();
  for (const Vector3d& p : body.vertices_in_body) {
    reach = reach.cwiseMax(Vector3d(2 * std::abs(p.x()), 2 * std::abs(p.y()), p.z()));
  }
  return reach;
}

}  // namespace omnimapper::sim
