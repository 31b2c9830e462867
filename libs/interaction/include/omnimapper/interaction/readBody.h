#pragma once

#include <mrpt/obs/CObservationSkeleton.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/interaction/TrackedBody.h>

#include <optional>
#include <string>

namespace omnimapper::interaction {

enum class SkeletonUnit { recognised, m, mm };

/// What the coordinates of joints mean. MRPT documents neither; its own driver for NiTE writes y up.
enum class SkeletonAxes {
  recognised,       ///< those of the following with which the body stands most upright on the base
  sensor,           ///< in the frame of sensorPose
  flipped_y,        ///< as `sensor`, but y has the other sign: y up, where the sensor's frame has y down
  forward_y_up,     ///< x right, y up, z ahead, where the sensor's frame has x ahead and z up
  forward_optical,  ///< x right, y down, z ahead, where the sensor's frame has x ahead and z up
};

/// How to read the skeletons of a tracker.
struct SkeletonFormat {
  SkeletonUnit unit = SkeletonUnit::recognised;
  SkeletonAxes axes = SkeletonAxes::recognised;
  bool is_mirrored = false;  ///< whether the tracker calls the person's right its left
  /// [0, 1] below which a joint counts as guessed. A joint with confidence 0 is absent, unless all have 0.
  double guessed_confidence = 0.75;

  static const base::OptionTable<SkeletonFormat>& table();
};

/// A person, or why the skeleton is of no use.
struct BodyReading {
  std::optional<TrackedBody> body;  ///< in the frame of the base
  std::string why_not;              ///< one sentence, if there is no body
};

/// The person in a skeleton. Joints that are not finite, that are at the origin of the sensor, or whose confidence is 0
/// are absent. The unit is recognised by the lengths of limbs: millimetres if their median is above 3. The axes are
/// recognised by the body, which stands, sits or bends by less than 45 deg; lying people need declared axes. There is
/// no body if no hand, or neither of its elbow and the head, is known, or if its limbs are longer than 1 m.
BodyReading readBody(const mrpt::obs::CObservationSkeleton& skeleton, const SkeletonFormat& format);

}  // namespace omnimapper::interaction
