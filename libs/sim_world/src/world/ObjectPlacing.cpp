#include "ObjectPlacing.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <map>
#include <set>

#include "PlanChecks.h"

namespace omnimapper::sim {

namespace {

// The name of what carries the surface `on`; of a surface without a part, the surface itself.
std::string carrierOf(const std::string& on) {
  return on.substr(0, on.rfind('/'));
}

/// Sorts the objects of a plan by depth-first search.
class PlacingOrder {
 public:
  explicit PlacingOrder(const WorldPlan& plan) : plan_(plan), states_(plan.objects.size(), State::open) {
    for (std::size_t i = 0; i < plan.objects.size(); ++i) numbers_[plan.objects[i].name] = i;
  }

  std::vector<std::size_t> sort() {
    for (std::size_t i = 0; i < plan_.objects.size(); ++i) visit(i);
    return std::move(order_);
  }

 private:
  enum class State { open, begun, done };

  std::set<std::size_t> neededBy(const ObjectPlan& object) const {
    std::set<std::size_t> needed;
    const auto add = [&](const std::string& name) {
      const auto found = numbers_.find(name);
      if (found != numbers_.end()) needed.insert(found->second);
    };
    add(carrierOf(object.place.on));
    add(object.touching);
    for (const MovePlan& move : object.moves) {
      if (move.place) add(carrierOf(move.place->on));
    }
    return needed;
  }

  void visit(std::size_t number) {
    if (states_[number] == State::done) return;
    path_.push_back(plan_.objects[number].name);
    if (states_[number] == State::begun) refuseCircle();
    states_[number] = State::begun;
    for (const std::size_t needed : neededBy(plan_.objects[number])) visit(needed);
    states_[number] = State::done;
    path_.pop_back();
    order_.push_back(number);
  }

  [[noreturn]] void refuseCircle() const {
    const std::string& name = path_.back();
    std::string circle;
    for (auto at = std::find(path_.begin(), path_.end(), name); at != path_.end(); ++at)
      circle += (circle.empty() ? "'" : " -> '") + *at + "'";
    refuse(plan_, name, "on",
           "objects carry or touch one another in a circle, " + circle +
               "; let one of them stand on furniture or on the floor at all times");
  }

  const WorldPlan& plan_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<State> states_;
  std::vector<std::string> path_;
  std::vector<std::size_t> order_;
};

MadeObject makeObjectOf(const WorldPlan& plan, std::size_t number) {
  const ObjectPlan& object = plan.objects[number];
  ObjectSpec spec;
  spec.name = object.name;
  spec.shape = object.shape;
  spec.seed = seedOfObject(plan.seed, number);
  spec.moveable = object.moveable;
  if (object.length > 0 || object.width > 0 || object.height > 0) {
    if (!(object.length > 0 && object.width > 0 && object.height > 0))
      refuse(plan, object.name, "length_m", "give all of length_m, width_m and height_m, or none");
    spec.size = Eigen::Vector3d(object.length, object.width, object.height);
  }
  try {
    return makeObject(spec);
  } catch (const base::Error& error) {
    refuse(plan, object.name, "class", error.what());
  }
}

}  // namespace

std::vector<std::size_t> orderOfPlacing(const WorldPlan& plan) {
  return PlacingOrder(plan).sort();
}

std::vector<MadeObject> placeObjects(const WorldPlan& plan, StandingSpace& floor) {
  std::vector<MadeObject> made;
  for (std::size_t i = 0; i < plan.objects.size(); ++i) made.push_back(makeObjectOf(plan, i));
  for (const std::size_t i : orderOfPlacing(plan)) {
    const ObjectPlan& object = plan.objects[i];
    Body& body = made[i].body;
    body.track = floor.trackOf({object.name, object.place, object.moves, spaceOf(body), object.touching});
    if (made[i].top) floor.addObjectTop(object.name, *made[i].top, body.track);
  }
  return made;
}

}  // namespace omnimapper::sim
