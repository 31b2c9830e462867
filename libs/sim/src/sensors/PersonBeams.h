#pragma once

#include <omnimapper/sim/LaserOptics.h>

#include <string>
#include <vector>

namespace omnimapper::sim {

/// First line of truth/<label>_bodies.csv, without its end. The columns are the stamp and the number of the
/// measurement; the person and the body, which is a part of the person; the speed of the person's trunk [m/s]; the
/// index of the first of successive beams that ended on that body, and their number; and how the echo is: "clear",
/// "mixed" (the range is a mean of several surfaces), "mirrored" (by a pane, so that the measured point is elsewhere)
/// or "missed" (no echo).
extern const char* const kPersonBeamsColumns;

/// Finds the beams of a 2D scan that end on people.
class PersonBeams {
 public:
  /// `world` must outlive this object.
  explicit PersonBeams(const World& world);
  bool hasPeople() const { return !world_.people.empty(); }
  /// The lines of a scan, in the order of the beams; echo i is that of beam i. `stamp` is text, `time` that of the scan
  /// [s].
  std::string rows(const std::vector<Echo>& echoes, int measurement, const std::string& stamp, double time) const;

 private:
  struct Owner {
    int person = -1, body = -1;  // indices in the world; negative: the surface belongs to no person
  };
  double speedOf(int person, double time) const;

  const World& world_;
  std::vector<Owner> owner_of_surface_;
};

}  // namespace omnimapper::sim
