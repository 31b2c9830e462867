#pragma once

#include <omnimapper/interaction/PointingGesture.h>

#include <optional>
#include <vector>

namespace omnimapper::plugins {

/// Tells people apart by where they are, and says who is in control: whoever was understood last, or else the person
/// nearest to the sensor.
class PeopleWatch {
 public:
  explicit PeopleWatch(const interaction::GestureOptions& options) : options_(options) {}

  /// Takes a skeleton in a frame with z up that does not move. Returns the gestures that the person in control makes
  /// now: none if the skeleton is that of another person.
  std::vector<interaction::PointingGesture> add(base::Stamp stamp, const interaction::TrackedBody& body);

  /// A gesture of the person whose skeleton came last was understood: that person is in control from now on, and the
  /// same holding still of that arm is not returned again.
  void understood(const interaction::PointingGesture& gesture);

 private:
  struct Person {
    explicit Person(const interaction::GestureOptions& options) : watch(options) {}
    interaction::GestureWatch watch;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double distance = 0;  // [m] from the sensor
    bool has_control = false;
    int used_left = 0, used_right = 0;  // the last hold that was understood
  };
  Person& personAt(const Eigen::Vector3d& middle, base::Stamp stamp);
  bool isInControl(const Person& person) const;

  interaction::GestureOptions options_;
  std::vector<Person> people_;
  std::size_t latest_ = 0;  // the person whose skeleton came last
};

}  // namespace omnimapper::plugins
