// Crowded surfaces: thin objects, objects that touch, and stacks (Arrangement::crowdSurfaces).
#include <omnimapper/sim_world/ObjectMaking.h>

#include <algorithm>
#include <cmath>

#include "Arrangement.h"
#include "ItemSpace.h"
#include "PlanChecks.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

namespace {

/// Something small to put on a crowded surface; sizes of 0 are the usual ones [m].
struct SmallThing {
  const char* shape;
  double length = 0, width = 0, height = 0;
};
constexpr SmallThing kSmallThings[] = {{"book"},
                                       {"book", 0.21, 0.28, 0.006},
                                       {"book", 0.12, 0.18, 0.015},
                                       {"box"},
                                       {"box", 0.2, 0.14, 0.1},
                                       {"box", 0.15, 0.1, 0.02},
                                       {"plate"},
                                       {"bowl"},
                                       {"cup"},
                                       {"can"},
                                       {"bottle"},
                                       {"brick"},
                                       {"prism"},
                                       {"ball", 0.08, 0.08, 0.08}};

constexpr double kBelowCabinets = 0.5;  // free height above tables and counters [m]

struct Thing {
  ObjectPlan plan;
  ItemSpace space;
  Vector2d reach;  // extents of its outline about its middle [m]
  std::optional<LevelTop> top;
};

// Draws an object; `number` will be its number in the plan.
Thing drawThing(Random& random, std::uint64_t world_seed, std::size_t number) {
  const SmallThing& small = kSmallThings[random.integer(0, static_cast<int>(std::size(kSmallThings)) - 1)];
  ObjectSpec spec;
  spec.shape = spec.name = small.shape;
  spec.seed = seedOfObject(world_seed, number);
  if (small.length > 0) spec.size = Eigen::Vector3d(small.length, small.width, small.height);
  MadeObject made = makeObject(spec);
  Thing thing;
  thing.plan.shape = small.shape;
  thing.plan.length = small.length, thing.plan.width = small.width, thing.plan.height = small.height;
  thing.space = spaceOf(made.body);
  thing.reach = reachOf(made.body).head<2>();
  thing.top = std::move(made.top);
  return thing;
}

/// Objects that stand together about a middle, the first one on the surface. Places are in the frame of the group.
struct Group {
  std::vector<Thing> things;
  Vector2d reach{0, 0};
  double height = 0;
};

// Two objects side by side that touch.
Group pairOf(Thing first, Thing second) {
  Group group;
  group.reach = {first.reach.x() + second.reach.x(), std::max(first.reach.y(), second.reach.y())};
  group.height = std::max(first.space.height, second.space.height);
  first.plan.place.x = -second.reach.x() / 2;
  second.plan.place.x = first.reach.x() / 2;
  group.things = {std::move(first), std::move(second)};
  return group;
}

bool standsOn(const Thing& above, const Thing& below) {
  return below.top && isWithin(above.space.foot, below.top->outline_in_body);
}

Group stackOf(Thing below, Thing above) {
  Group group{{}, below.reach.cwiseMax(above.reach), below.space.height + above.space.height};
  group.things = {std::move(below), std::move(above)};
  return group;
}

}  // namespace

void Arrangement::crowd(Top& top) {
  constexpr int kTries = 8;  // for an object that fits on another one
  enum How { alone, touching, stacked };
  const int how = std::min<int>(random.integer(0, 3), stacked);  // as many stacks as all others
  const std::size_t number = plan.objects.size();
  Thing first = drawThing(random, plan.seed, number);
  std::optional<Thing> second;
  if (how == touching) second = drawThing(random, plan.seed, number + 1);
  for (int i = 0; how == stacked && !second && i < kTries; ++i) {
    Thing above = drawThing(random, plan.seed, number + 1);
    if (standsOn(above, first)) second = std::move(above);
  }
  Group group{{}, first.reach, first.space.height};
  if (!second)
    group.things.push_back(std::move(first));
  else if (how == touching)
    group = pairOf(std::move(first), std::move(*second));
  else
    group = stackOf(std::move(first), std::move(*second));
  if (group.height >= std::min(top.headroom, kBelowCabinets)) return;
  const auto at = freePlace(top, group.reach);
  if (!at) return;
  std::string below = top.surface, beside;
  for (Thing& thing : group.things) {
    const Vector2d offset = Eigen::Rotation2Dd(at->yaw) * Vector2d(thing.plan.place.x, thing.plan.place.y);
    thing.plan.name = newName(thing.plan.shape);
    thing.plan.place = {at->x + offset.x(), at->y + offset.y(), at->yaw, below};
    thing.plan.touching = beside;
    (how == touching ? beside : below) = how == touching ? thing.plan.name : thing.plan.name + "/top";
    plan.objects.push_back(std::move(thing.plan));
  }
}

void Arrangement::crowdSurfaces(double per_square_metre) {
  if (per_square_metre <= 0) return;
  for (const FurniturePlan& piece : plan.furniture) {
    for (int board = 2; board < boardsOf(piece); ++board)
      topOf(piece, "board_" + std::to_string(board));  // the lowest and the highest one are hard to see
  }
  for (Top& top : tops_) {
    const double area = doubleArea(top.usable_in_map) / 2;
    const auto groups = static_cast<int>(std::lround(area * per_square_metre));
    for (int group = 0; group < groups; ++group) crowd(top);
  }
}

}  // namespace omnimapper::sim
