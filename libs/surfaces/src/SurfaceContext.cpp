#include "SurfaceContext.h"

#include <omnimapper/geometry/ConvexPolygon2.h>

#include <algorithm>
#include <cmath>

#include "Touching.h"

namespace omnimapper::surfaces {

namespace {

using Class = SurfaceClass;

/// A surface with its facts and the class that it has by itself.
struct Judged {
  const Surface* surface;
  const SurfaceFacts* facts;
  Class is;
  bool isUpright() const { return facts->lie == Lie::upright && !facts->plan.empty(); }
  bool isLevel() const { return facts->lie == Lie::up && !facts->plan.empty(); }
  double height() const { return (facts->bottom + facts->top) / 2; }
};

// Length along which `other`, which runs along the same line, lies beside the upright surface.
double sharedLength(const Judged& one, const Judged& other) {
  const Eigen::Vector2d along = alongFloor(one.surface->plane);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto& corner : other.facts->plan) {
    low = std::min(low, along.dot(corner));
    high = std::max(high, along.dot(corner));
  }
  return std::min(high, one.facts->along.y()) - std::max(low, one.facts->along.x());
}

bool areFacesOfALeaf(const Judged& one, const Judged& other) {
  constexpr double kOpposite = -0.985;  // cosine of the angle between the normals
  constexpr double kThickest = 0.07, kNarrowest = 0.6, kWidest = 1.7, kLowest = 1.2;  // [m]
  constexpr double kShared = 0.5;                                                     // of the narrower one
  if (!one.isUpright() || !other.isUpright()) return false;
  if (one.surface->plane.normal.dot(other.surface->plane.normal) > kOpposite) return false;
  const double apart = -signedDistance(one.surface->plane, other.facts->middle);
  const double wider = std::max(one.facts->longer, other.facts->longer);
  return apart > 0 && apart <= kThickest && wider >= kNarrowest && wider <= kWidest &&
         std::max(one.facts->top, other.facts->top) >= kLowest && overlapInHeight(*one.facts, *other.facts) &&
         sharedLength(one, other) >= kShared * std::min(one.facts->longer, other.facts->longer);
}

// Whether `side` leads away from the viewer at an end of a front, as deep as furniture is.
bool isSideOfBox(const Judged& front, const Judged& side) {
  constexpr double kLeast = 0.3, kMost = 0.85;  // [m]
  if (!side.isUpright() || side.is == Class::wall || side.is == Class::door_frame || side.is == Class::door)
    return false;
  if (side.facts->longer < kLeast || side.facts->longer > kMost || !overlapInHeight(*front.facts, *side.facts))
    return false;
  return geometry::distance(front.facts->plan, side.facts->plan) <= kTouch &&
         meetAtEnd(*front.surface, *front.facts, *side.surface, *side.facts) &&
         liesBehind(*front.surface, *side.facts) && liesBehind(*side.surface, *front.facts);
}

bool isBackOf(const Judged& seat, const Judged& back) {
  constexpr double kHigher = 0.12;  // [m]
  return back.isUpright() && back.facts->top >= seat.height() + kHigher &&
         back.facts->bottom <= seat.height() + kTouch &&
         geometry::distance(seat.facts->plan, back.facts->plan) <= kTouch;
}

/// Corrects one judgement after another; each sees what the others were at first.
class Context {
 public:
  Context(const std::vector<Surface>& surfaces, const std::vector<SurfaceFacts>& facts,
          const std::vector<Judgement>& judgements) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) all_.push_back({&surfaces[i], &facts[i], judgements[i].is});
  }

  void correct(std::size_t i, Judgement& judgement) const {
    const Judged& one = all_[i];
    const auto isAny = [&](const auto& fits) {
      return std::any_of(all_.begin(), all_.end(), [&](const Judged& other) { return &other != &one && fits(other); });
    };
    if (one.isUpright() && isAny([&](const Judged& other) { return areFacesOfALeaf(one, other); })) {
      change(judgement, Class::door, "its other face is as near as that of a leaf");
    } else if (one.is == Class::wall && isAny([&](const Judged& other) { return isSideOfBox(one, other); })) {
      change(judgement, Class::cabinet, "a side of furniture begins at its end");
    } else if (one.is == Class::wall && isTooNarrow(one)) {
      change(judgement, isFrame(one) ? Class::door_frame : Class::surface, "too narrow for a wall");
    } else if (one.is == Class::seat && isDeep(one) &&
               !isAny([&](const Judged& other) { return isBackOf(one, other); })) {
      change(judgement, Class::table, "no back and no arms");
    }
  }

 private:
  static bool isTooNarrow(const Judged& wall) {
    constexpr double kNarrow = 0.75, kHigh = 1.6;  // [m]
    return wall.facts->plane_width < kNarrow && wall.facts->top < kHigh;
  }
  static bool isFrame(const Judged& narrow) {
    constexpr double kNarrow = 0.25, kHigh = 1.2;  // [m]
    return narrow.facts->longer < kNarrow && narrow.facts->top > kHigh;
  }
  static bool isDeep(const Judged& seat) {
    constexpr double kDeep = 0.5, kLong = 0.7;  // [m]
    return seat.isLevel() && seat.facts->shorter >= kDeep && seat.facts->longer >= kLong;
  }
  static void change(Judgement& judgement, Class is, const std::string& why) {
    if (judgement.is == is) return;
    judgement.is = is;
    judgement.reason += "; " + toString(is) + ", because of what is around it: " + why;
  }

  std::vector<Judged> all_;
};

}  // namespace

void judgeInContext(const std::vector<Surface>& surfaces, const std::vector<SurfaceFacts>& facts,
                    std::vector<Judgement>& judgements) {
  const Context context(surfaces, facts, judgements);
  for (std::size_t i = 0; i < judgements.size(); ++i) context.correct(i, judgements[i]);
}

}  // namespace omnimapper::surfaces
