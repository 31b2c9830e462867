#include "PeopleWatch.h"

#include <algorithm>
#include <cmath>

namespace omnimapper::plugins {

namespace {

constexpr double kGone = 1;      // [s] without a skeleton, after which a person has left
constexpr double kNearby = 0.8;  // [m] between two skeletons of one person

}  // namespace

PeopleWatch::Person& PeopleWatch::personAt(const Eigen::Vector3d& middle, base::Stamp stamp) {
  people_.erase(std::remove_if(people_.begin(), people_.end(),
                               [&](const Person& person) {
                                 return std::abs(base::secondsBetween(person.watch.last(), stamp)) > kGone;
                               }),
                people_.end());
  // Two people may stand close together: the nearest is the same person, unless it was seen at this very time.
  std::size_t nearest = people_.size();
  double least = kNearby;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const double off = (people_[i].middle - middle).norm();
    if (off > least || people_[i].watch.last() == stamp) continue;
    nearest = i;
    least = off;
  }
  if (nearest == people_.size()) people_.emplace_back(options_);
  latest_ = nearest;
  return people_[nearest];
}

bool PeopleWatch::isInControl(const Person& person) const {
  if (person.has_control) return true;
  return std::none_of(people_.begin(), people_.end(),
                      [&](const Person& other) { return other.has_control || other.distance < person.distance; });
}

std::vector<interaction::PointingGesture> PeopleWatch::add(base::Stamp stamp, const interaction::TrackedBody& body) {
  const auto middle = interaction::middleOf(body);
  if (!middle) return {};
  Person& person = personAt(*middle, stamp);
  person.middle = *middle;
  person.distance = (*middle - body.sensor).norm();
  auto gestures = person.watch.add(stamp, body);
  if (!isInControl(person)) return {};
  gestures.erase(std::remove_if(gestures.begin(), gestures.end(),
                                [&](const interaction::PointingGesture& gesture) {
                                  return gesture.hold == (gesture.is_right_arm ? person.used_right : person.used_left);
                                }),
                 gestures.end());
  return gestures;
}

void PeopleWatch::understood(const interaction::PointingGesture& gesture) {
  for (Person& person : people_) person.has_control = false;
  Person& person = people_[latest_];
  person.has_control = true;
  (gesture.is_right_arm ? person.used_right : person.used_left) = gesture.hold;
}

}  // namespace omnimapper::plugins
