#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/perception/Extractor.h>

#include <memory>
#include <string>

namespace omnimapper::signs {

struct DoorSignOptions {
  enum class Detector { text, saliency };
  enum class Backend { opencv, onnx_runtime };
  enum class Reader { network, tesseract };
  Detector detector = Detector::text;
  std::string model;                  ///< file of the classifier; empty: the shipped one
  double min_score = 0.6;             ///< smallest probability of a region that the classifier accepts
  std::string models;                 ///< folder of the networks; empty: where scripts/models puts them
  Backend backend = Backend::opencv;  ///< library that runs the networks
  Reader reader = Reader::network;    ///< what reads the lines of text
  std::string letters;                ///< characters that texts consist of; empty: Alphabet::common()
  double min_confidence = 0.3;        ///< lines with a lower confidence are left out
  double min_height = 8;              ///< [px] lines of text with a smaller height are left out
  double least_change = 16;           ///< [grey levels] an image is new if a part of it changed by more; 0: every image

  static const base::OptionTable<DoorSignOptions>& table();
};

/// The label of an image's signs is the image's label with this suffix.
inline constexpr char kSignsSuffix[] = ".signs";

/// Finds the door signs in an image and reads what is written on them (thesis 3.5.1.1 and 3.5.3). A network finds lines
/// of text (TextDetector), another network or Tesseract reads these lines, and findPlates() finds the plate around
/// them.
///
/// Each image gives one observation with the image's stamp, the label "<label>.signs" and the camera's pose as
/// sensorPose (z forward); its signs are sorted from left to right. The ray of a sign points to where its diagonals
/// cross; the range is set if the same observation has depths of the plate (PlateRanges). The score of a sign is the
/// best score of its lines as text or, with the detector `saliency`, the classifier's probability. The confidence of a
/// text is the probability that it was read correctly (doc/results/signs.md); the patch shows the plate alone, upright.
/// Images must have 8 bits and 1 or 3 channels; others give no signs. Lens models are those of MRPT's TCamera.
///
/// The constructor throws Error(unreadable_input) if a network is missing or broken, and Error(plugin_library) if ONNX
/// Runtime or Tesseract is missing or broken. signsIn() throws Error(missing_images) for an image in a file that was
/// not loaded, and Error(unreadable_input) if the camera's calibration is not usable or was made for images of another
/// aspect ratio (a calibration for images of another size but the same aspect ratio is scaled). Thread-safe; the same
/// image gives the same bits on one kind of processor.
class DoorSignExtractor : public perception::Extractor {
 public:
  static constexpr const char* kName = "DoorSignExtractor";
  static constexpr const char* kSummary = "Door signs and what is written on them, from images.";

  explicit DoorSignExtractor(const DoorSignOptions& options);
  ~DoorSignExtractor() override;

  /// The signs in the image of `raw` (camera::pictureOf()); no signs if there is no image.
  obs::CObservationDoorSigns::Ptr signsIn(const mrpt::obs::CObservation& raw) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;
  /// An image is new if it differs from the camera's last new image by more than `least_change`. Null if `least_change`
  /// is 0: every image is new then.
  std::unique_ptr<perception::Novelty> novelty() const override;

 private:
  class Finder;
  double least_change_;
  std::unique_ptr<const Finder> finder_;
};

}  // namespace omnimapper::signs
