#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/perception/Extractor.h>

namespace omnimapper::perception {

struct ArucoMarkerOptions {
  enum class Dictionary {
    dict_4x4_50,
    dict_4x4_100,
    dict_4x4_250,
    dict_4x4_1000,
    dict_5x5_50,
    dict_5x5_100,
    dict_5x5_250,
    dict_5x5_1000,
    dict_6x6_50,
    dict_6x6_100,
    dict_6x6_250,
    dict_6x6_1000,
    dict_7x7_50,
    dict_7x7_100,
    dict_7x7_250,
    dict_7x7_1000,
    original,
    april_16h5,
    april_25h9,
    april_36h10,
    april_36h11
  };
  enum class Refinement { none, gradients, edges };
  Dictionary dictionary = Dictionary::dict_4x4_50;
  double side = 0.16;                         ///< [m] side of the black square
  double corner_sigma = 0.3;                  ///< [px] standard deviation of a corner along each image axis
  double min_side = 16;                       ///< [px] markers with a shorter side are left out
  Refinement refinement = Refinement::edges;  ///< how corners are refined

  static const base::OptionTable<ArucoMarkerOptions>& table();
};

/// The label of a picture's markers is the picture's label with this suffix.
inline constexpr char kMarkersSuffix[] = ".markers";

/// Extracts the square markers in a picture; each becomes a point with the marker's number (thesis 4.6.3, which
/// measures ranges and bearings of ARToolKit Plus markers). Markers are detected by OpenCV's ArUco (Garrido-Jurado et
/// al.: Automatic generation and detection of highly reliable fiducial markers under occlusion, 2014), and a marker's
/// pose is fitted to its four corners by least squares.
///
/// Each picture gives one observation, with markers in the order of their ids. The observation has the picture's stamp
/// and the label "<label>.markers"; its sensorLocationOnRobot is the camera's pose, rotated to MRPT's axes (x forward,
/// y left, z up). Each measurement states where the marker's centre is, as range [m], yaw [rad, positive to the left]
/// and pitch [rad, positive down]; its landmarkID is the marker's id. The covariance of range, yaw and pitch follows
/// from `corner_sigma` to first order, and the marker's orientation counts as unknown. Noise can only make a marker
/// that faces the camera seem tilted; the squared errors of such a marker are about a third larger than the covariance
/// says.
/// Pictures must have 8 bits and 1 or 3 channels; others give no markers. Lens models are those of MRPT's TCamera:
/// none, plumb_bob, kannala_brandt.
///
/// markersIn() throws Error(missing_images) for a picture in a file that was not loaded (sources load such files), and
/// Error(unreadable_input) for a camera with a focal length below 1 px or a parameter that is not finite or beyond 10^6
/// px, unless the picture has no pixels. Thread-safe; the same picture gives the same bits.
class ArucoMarkerExtractor : public Extractor {
 public:
  static constexpr const char* kName = "ArucoMarkerExtractor";
  static constexpr const char* kSummary =
      "Finds square markers with numbers in pictures and measures their ranges and bearings.";

  explicit ArucoMarkerExtractor(const ArucoMarkerOptions& options) : options_(options) {}

  /// The markers in the observation's picture (pictureOf()). If there is no picture, the result contains no markers.
  mrpt::obs::CObservationBearingRange::Ptr markersIn(const mrpt::obs::CObservation& raw) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  ArucoMarkerOptions options_;
};

}  // namespace omnimapper::perception
