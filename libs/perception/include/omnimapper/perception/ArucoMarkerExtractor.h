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
  double side = 0.16;                         ///< [m] of the black square
  double corner_sigma = 0.3;                  ///< [px] of a corner along each axis of the image
  double min_side = 16;                       ///< [px]; a marker with a shorter side is left out
  Refinement refinement = Refinement::edges;  ///< of the corners

  static const base::OptionTable<ArucoMarkerOptions>& table();
};

/// What the label of a picture's markers has behind the picture's own.
inline constexpr char kMarkersSuffix[] = ".markers";

/// The square markers that a picture shows, as points with numbers (thesis 4.6.3 has ARToolKit Plus markers taken for
/// ranges and bearings). Found by OpenCV's ArUco (Garrido-Jurado et al.: Automatic generation and detection of highly
/// reliable fiducial markers under occlusion, 2014); the marker's pose is that of least squares of its four corners.
///
/// Each makes one observation, markers in order of their ids: stamp of the picture, label "<label>.markers", its
/// sensorLocationOnRobot is the camera's place turned to MRPT's axes (x forward, y left, z up). A measurement is the
/// middle of the marker: range [m], yaw to the left and pitch down [rad], landmarkID the marker's id, covariance of
/// range, yaw, pitch from `corner_sigma` to first order, with the marker's turn unknown. For a marker that faces the
/// camera, where noise makes only lean, squared errors are about a third larger than that tells.
/// Pictures of 8 bits with 1 or 3 channels; others show nothing. Lenses as MRPT's TCamera has them: none, plumb_bob,
/// kannala_brandt.
///
/// markersIn() throws Error(missing_images) for a picture that is in a file and was not loaded; sources load them; and
/// Error(unreadable_input) for a camera whose focal length is below 1 px, or a parameter not finite or beyond 10^6 px,
/// unless the picture has no pixels. Thread-safe; the same picture gives the same bits.
class ArucoMarkerExtractor : public Extractor {
 public:
  static constexpr const char* kName = "ArucoMarkerExtractor";
  static constexpr const char* kSummary = "Square markers with numbers, from pictures, by range and bearing.";

  explicit ArucoMarkerExtractor(const ArucoMarkerOptions& options) : options_(options) {}

  /// Of the picture that it brings (pictureOf()); without one there are no markers.
  mrpt::obs::CObservationBearingRange::Ptr markersIn(const mrpt::obs::CObservation& raw) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;

 private:
  ArucoMarkerOptions options_;
};

}  // namespace omnimapper::perception
