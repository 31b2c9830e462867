#pragma once

#include <omnimapper/obs/CObservationObjects.h>
#include <omnimapper/perception/Extractor.h>
#include <omnimapper/perception/ObjectFinder.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <atomic>

namespace omnimapper::perception {

struct ObjectPointOptions {
  int max_points = 1000;  ///< of an object that are handed on

  static const base::OptionTable<ObjectPointOptions>& table();
};

/// What the label of a scan's objects has behind the scan's own.
inline constexpr char kObjectsSuffix[] = ".objects";

/// The planes that a range camera's depth image shows and the things that stand on them, as ObjectFinder finds them
/// (thesis 3.4.6, 3.5.1.2). It does what a PlaneExtractor with the same options does, too: things name their plane by
/// its index.
class ObjectExtractor : public Extractor {
 public:
  static constexpr const char* kName = "ObjectExtractor";
  static constexpr const char* kSummary =
      "Planes of depth images as PlaneExtractor has them, and the things that stand on them.";

  struct Options {
    PlaneOptions planes;
    OutlineOptions outlines;
    ObjectOptions objects;
    ObjectPointOptions points;
  };
  struct Found {
    std::shared_ptr<obs::CObservationPlanes> planes;
    std::shared_ptr<obs::CObservationObjects> objects;
    bool has_surface = false;  ///< whether the scan shows a level surface that things may stand on
  };

  /// Throws as PlaneSegmenter and ObjectFinder.
  explicit ObjectExtractor(const Options& options)
      : options_(options), segmenter_(options.planes), finder_(options.objects, options.planes) {}
  ObjectExtractor(const PlaneOptions& planes, const OutlineOptions& outlines, const ObjectOptions& objects,
                  const ObjectPointOptions& points)
      : ObjectExtractor(Options{planes, outlines, objects, points}) {}

  /// Both with the scan's stamp and sensorPose, in the frame of that pose, labels "<scan label>.planes" and
  /// "<scan label>.objects"; which way is up is told by sensorPose. Of an object's points every so manieth is kept,
  /// with its colour where the scan has one for each. Throws as PlaneExtractor. Thread-safe; the same scan gives the
  /// same bits.
  Found extract(const mrpt::obs::CObservation3DRangeScan& scan) const;

  bool wants(const mrpt::obs::CObservation& raw) const override;
  std::vector<mrpt::obs::CObservation::Ptr> extract(const mrpt::obs::CObservation& raw) const override;
  std::vector<DerivedName> namesOf(const mrpt::obs::CObservation& raw) const override;
  /// If no scan showed a level surface.
  std::vector<std::string> warnings() const override;

 private:
  Options options_;
  PlaneSegmenter segmenter_;
  ObjectFinder finder_;
  mutable std::atomic<std::size_t> scans_{0}, with_surface_{0};  // that extract(raw) was given
};

}  // namespace omnimapper::perception
