#pragma once

#include <omnimapper/source/SourceReport.h>

#include <set>
#include <string>

#include "Plan.h"
#include "ReorderBuffer.h"
#include "Transforms.h"

namespace omnimapper::ros {

/// Mounts sensors on the base as the transforms say at the time of each measurement. A sensor that nothing connects
/// with the base is taken to be at the base.
class Mounting {
 public:
  /// `plan` must outlive this object.
  explicit Mounting(const Plan& plan) : plan_(plan) {}

  /// Sets the sensor's pose on the base. Returns why it is not known; empty if it is set.
  std::string mount(const Waiting& waiting, const Transforms& transforms);
  /// Adds what was taken to be so, to the notes and the doubts.
  void addTo(source::SourceReport& report) const;

 private:
  static constexpr std::size_t kMostNamed = 100;  // sensors; a log can have any number of frames
  void noteUnmounted(source::SourceReport& report) const;

  const Plan& plan_;
  std::set<SensorKey> unmounted_;
  std::set<std::string> other_bases_;  // of which there are few, as they have the names of bases
};

}  // namespace omnimapper::ros
