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
  std::string model;                  ///< of the classifier; empty: the one that is shipped
  double min_score = 0.6;             ///< of a region, by the classifier
  std::string models;                 ///< folder of the networks; empty: where scripts/models puts them
  Backend backend = Backend::opencv;  ///< what computes them
  Reader reader = Reader::network;    ///< of lines
  std::string letters;                ///< what texts consist of; empty: Alphabet::common()
  double min_confidence = 0.3;        ///< of a line; others are left out
  double min_height = 8;              ///< [px] of a line; lower ones are left out
  double least_change = 16;           ///< [grey levels] of some part of an image; else it shows nothing new

  static const base::OptionTable<DoorSignOptions>& table();
};

/// What the label of an image's signs has behind the image's own.
inline constexpr char kSignsSuffix[] = ".signs";

/// The door signs that an image shows, with what is written on them (thesis 3.5.1.1 and 3.5.3): lines of text are found
/// by a network (TextDetector) and read by another or by Tesseract, and the plate that they are on is found about them
/// (findPlates).
///
/// Each image makes one observation: stamp of the image, label "<label>.signs", sensorPose the camera's, z forward;
/// signs from the left to the right of the image. A ray goes to where the diagonals of the sign cross; the range is
/// left to who knows more. The score of a sign is that of its lines as text, or the classifier's. The confidence of a
/// text is the probability that it was read right (doc/results/signs.md); the patch is the plate alone, upright.
/// Pictures of 8 bits with 1 or 3 channels; others show nothing. Lenses as MRPT's TCamera has them.
///
/// The constructor throws Error(unreadable_input) if a network is missing or broken, and Error(plugin_library) if ONNX
/// Runtime or Tesseract is; signsIn() Error(missing_images) for an image that is in a file and was not loaded, and
/// Error(unreadable_input) for a camera without a calibration that can be used, or with one of images of another shape
/// (of images of the same shape it is scaled). Thread-safe; the same image gives the same bits on one kind of
/// processor.
class DoorSignExtractor : public perception::Extractor {
 public:
  static constexpr const char* kName = "DoorSignExtractor";
  static constexpr const char* kSummary = "Door signs and what is written on them, from images.";

  explicit DoorSignExtractor(const DoorSignOptions& options);
  ~DoorSignExtractor() override;

  /// Of the picture that it brings (perception::pictureOf()); without one there are no signs.
  obs::CObservationDoorSigns::Ptr signsIn(const mrpt::obs::CObservation& raw) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<perception::DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;
  /// Images that differ from the one before by less than `least_change` show nothing new.
  std::unique_ptr<perception::Novelty> novelty() const override;

 private:
  class Finder;
  double least_change_;
  std::unique_ptr<const Finder> finder_;
};

}  // namespace omnimapper::signs
