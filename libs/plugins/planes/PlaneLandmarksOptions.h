#pragma once

#include <omnimapper/plugin/Association.h>

#include <cstdint>

namespace omnimapper::plugins {

struct PlaneLandmarksOptions : mapper::AssociationOptions {
  enum class Form { plane, wall };
  Form form = Form::plane;
  /// Height of the floor, above which a level surface can be a table: that of the base at the first key frame (start),
  /// or z = 0 of the map (map).
  enum class Ground : std::uint8_t { start = 0, map = 1 };
  Ground ground = Ground::start;
  /// How the measured parts of a surface become its boundary in the map.
  enum class Boundary : std::uint8_t {
    hull = 0,  ///< their convex hull
    seen = 1   ///< their union, with bays and holes
  };
  Boundary boundary = Boundary::seen;
  bool planes = true;       ///< measure CObservationPlanes
  bool lines = true;        ///< measure CObservationLaserLines
  double min_area = 0.25;   ///< [m^2] of a plane measurement that creates a landmark
  double min_length = 0.8;  ///< [m] of a line measurement that creates a landmark
  /// [m] Largest gap between stretches of one wall, for lines and for surfaces that are higher than furniture.
  double max_gap = 0.5;
  /// [m] Largest gap between other surfaces of one landmark.
  double max_plane_gap = 0.15;
  /// Parts of a surface that are measured from farther away or more obliquely are drawn only where nothing better is
  /// known: depth noise grows with the square of the distance, and mixed pixels at edges reach far along a grazing ray.
  double well_seen_within = 4;                                         ///< [m]
  double well_seen_under = 75 * base::option_text::kRadiansPerDegree;  ///< [rad] between the ray and the normal
  double plane_sigma = 0.01;                                           ///< [m] deviation of a surface from flat
  double plane_angle_sigma = base::option_text::kRadiansPerDegree;     ///< [rad]
  double line_sigma = 0.01;                                            ///< [m]
  double line_angle_sigma = base::option_text::kRadiansPerDegree / 2;  ///< [rad]
  double upright_sigma = 5 * base::option_text::kRadiansPerDegree;     ///< [rad]
  double loss_scale = 3;                                               ///< [sigma] of the Huber loss

  static const base::OptionTable<PlaneLandmarksOptions>& table();
};

}  // namespace omnimapper::plugins
