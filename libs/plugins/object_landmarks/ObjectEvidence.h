#pragma once

#include <omnimapper/base/Stamp.h>

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace omnimapper::plugins {

/// What one image says of an object that is in the map.
enum class Sight : std::uint8_t {
  unknown,  ///< it is out of view, too far away, or the depths decide nothing
  seen,     ///< the image shows a surface where the object has one
  hidden,   ///< something nearer to the camera is before it
  absent,   ///< the image shows what is behind it: looked for, and not there
};

/// The evidence for and against an object, over all images. The order in which it is added makes no difference.
struct ObjectEvidence {
  std::uint32_t seen_in = 0, hidden_in = 0, absent_in = 0;  ///< numbers of images
  base::Stamp first_seen, last_seen;                        ///< invalid if it was never seen
  base::Stamp last_looked;                                  ///< it was in view then: seen, hidden or absent
  /// The images later than `last_seen` from which it was absent, ascending, at most kMostStamps: the latest.
  std::vector<base::Stamp> absent_at;

  static constexpr std::size_t kMostStamps = 20;

  void add(Sight sight, base::Stamp stamp);
  /// Adds the evidence of another landmark that is the same object.
  void add(const ObjectEvidence& other);
  /// Whether the object was absent from at least this many images, over at least this time [s], since it was last seen.
  bool saysGone(int images, double seconds) const;

  void write(std::ostream& out) const;
  /// Throws Error(unreadable_input) if what it reads cannot be evidence.
  static ObjectEvidence read(std::istream& in);
};

}  // namespace omnimapper::plugins
