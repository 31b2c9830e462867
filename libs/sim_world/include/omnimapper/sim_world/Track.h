#pragma once

#include <omnimapper/geometry/Se3.h>

#include <optional>
#include <vector>

namespace omnimapper::sim {

/// The pose of a body over time. Times are seconds since the start of the simulation.
class Track {
 public:
  enum class Kind {
    steps,   ///< stays where it was put until it is put elsewhere, like objects that are carried in no time
    motion,  ///< goes linearly from one pose to the next, like people and robots
  };
  struct Place {
    double time;                                 ///< [s]
    std::optional<geometry::Se3> map_from_body;  ///< none: the body is not in the world from then on
  };

  /// Always at one pose.
  explicit Track(const geometry::Se3& map_from_body) : places_{{0.0, map_from_body}} {}
  /// Throws std::invalid_argument unless there is a place, times increase, and a motion has a pose at each.
  Track(Kind kind, std::vector<Place> places);

  /// The pose at a time. Before the first place, it is the pose of the first place; after the last place, that of the
  /// last one.
  std::optional<geometry::Se3> at(double time) const;

  Kind kind() const { return kind_; }
  const std::vector<Place>& places() const { return places_; }
  bool isFixed() const { return places_.size() == 1; }

 private:
  Kind kind_ = Kind::steps;
  std::vector<Place> places_;
};

}  // namespace omnimapper::sim
