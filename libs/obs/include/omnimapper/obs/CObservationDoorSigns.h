#pragma once

#include <mrpt/img/CImage.h>
#include <omnimapper/obs/CDerivedObservation.h>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace omnimapper::obs {

/// One line of text that was read.
struct ReadText {
  std::string text;       ///< UTF-8
  double confidence = 0;  ///< 0 to 1
};

/// A sign on or beside a door.
struct ObservedDoorSign {
  /// [px] corners of its region in the image, in the order upper left, upper right, lower right, lower left, as the
  /// text is read. x is to the right and y down; (0, 0) is the middle of the upper left pixel.
  std::array<Eigen::Vector2f, 4> corners_px{Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(),
                                            Eigen::Vector2f::Zero()};
  Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();  ///< unit, from the camera to the middle of the sign
  std::optional<double> range;                     ///< [m] along the ray, if it was measured
  double range_sigma = 0;                          ///< [m]
  bool is_cut = false;          ///< whether its region leaves the image; the ray is less accurate then
  double score = 0;             ///< of the classifier for signs, 0 to 1
  std::vector<ReadText> texts;  ///< from top to bottom
  mrpt::img::CImage patch;      ///< image of the region, 8 bit, grey or colour; may be empty
};

/// The door signs that were found in one image. The frame of the sensor is the camera's optical frame: z forward, x to
/// the right, y down. sensorPose is its pose on the base when the image was taken, which a pan-tilt unit changes.
class CObservationDoorSigns : public CDerivedObservation {
  DEFINE_SERIALIZABLE(CObservationDoorSigns, omnimapper::obs)

 public:
  std::vector<ObservedDoorSign> signs;

  std::string exportTxtHeader() const override;
  std::string exportTxtDataRow() const override;

 protected:
  void describe(std::ostream& out) const override;
  /// Draws the ray, the interval of the range plus and minus two range_sigma on the ray, the framed patch, and the
  /// text. A sign without range is drawn at 2 m.
  void draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const override;
};

}  // namespace omnimapper::obs
