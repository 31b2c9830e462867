#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/camera/LensStraightener.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/DenseMatcher.h>
#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "StraightImage.h"

namespace omnimapper::plugins {

struct ViewLinksOptions {
  std::string odometry = "visual_odometry";  ///< section whose camera, matching and shutters are used here, too
  int key_frames_back = 3;                   ///< links to the second, third, ... key frame before, up to this number
  int old_views = 2;                         ///< largest number of links of a key frame to older views
  int stored_views = 500;                    ///< largest number of older views; the oldest is dropped first
  double overlap = 0.5;                      ///< smallest share of an older view that is still visible
  double loss_scale = 1;                     ///< [standard deviations] from which on a link counts less

  std::vector<std::string> sectionsRead() const { return {odometry}; }
  static const base::OptionTable<ViewLinksOptions>& table();
};

/// Registers the image of each key frame with images of earlier key frames: with that of the second, third, ... key
/// frame before it (thesis 4.1.2: links to x-1, x-2 and x-3; odometry makes the link to x-1), and with older ones whose
/// views the image should show again, by the estimate. The links to older key frames close loops while drift is small.
/// The graph then distributes drift over the trajectory, whereas odometry alone corrects it at once.
///
/// An image that cannot be read is left out. The links of one key frame share its image, so they are not independent:
/// the covariance of each of n links is multiplied by n, so that together they count as one. Links to older views are
/// hypotheses, which act once the consistency test has accepted them.
class ViewLinksPlugin : public mapper::MeasurementPlugin {
 public:
  static constexpr const char* kName = "ViewLinksPlugin";
  static constexpr const char* kSummary =
      "Links key frames by their depth images: each to several key frames before it, and to older ones that show "
      "the same place.";

  /// What the plugin takes from the section of the camera's odometry.
  struct Camera {
    std::string label;  ///< empty: the first one observed
    matching::RgbdTrackerOptions tracking;
    matching::DenseMatcherOptions matching;
  };
  /// Reads the section of the odometry that the options name. Throws Error(unknown_key) if the INI does not have it,
  /// and Error(out_of_range) if it is not a camera's.
  ViewLinksPlugin(const ViewLinksOptions& options, const mapper::PluginContext& context);
  ViewLinksPlugin(const ViewLinksOptions& options, const Camera& camera, const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  /// Null for an image that cannot be read or has too few depths.
  std::unique_ptr<const mapper::Prepared> prepareUsing(const mrpt::obs::CObservation& observation,
                                                       const perception::Blackboard& board) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void retired(const map::KeyFrame& frame) override;
  /// The share of the time that lies between two views of one place, where drift would show; it stands in for the share
  /// that the odometry reports, which only compares images with its own key frames. Also, how many returns to a view
  /// lie elsewhere in the finished map than by the images, and how often the camera was, by the estimate, back at a
  /// view that the image did not show.
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;

 private:
  /// What prepareUsing() makes of an image.
  struct SeenImage : mapper::Prepared {
    std::shared_ptr<const StraightImage> image;
    geometry::Se3 base_from_camera;
    double depth;  // [m] median
  };
  /// The image of a key frame.
  struct KeyImage {
    base::KeyFrameId frame;
    std::shared_ptr<const matching::DenseReference> reference;
    geometry::Se3 base_from_camera;
    double depth;                 // [m] median
    geometry::Vector6d velocity;  // of the camera, in its frame [m/s] [rad/s]
  };
  /// An earlier image that an image was registered with.
  struct Link {
    const KeyImage* to;
    matching::DenseMatch match;
    bool is_old = false;     // to an older view
    bool is_return = false;  // to a view that the camera had left in between
  };
  /// A return to a view that the camera had left, as measured by the images.
  struct Return {
    base::KeyFrameId before, frame;
    geometry::Se3 before_from_camera, before_base_from_camera, base_from_camera;
    double depth;  // [m] median
  };
  mapper::Batch linksOf(const map::KeyFrame& frame, const SeenImage& seen, const mapper::View& view);
  std::optional<Link> linkTo(const KeyImage& to, const KeyImage& image, const matching::RgbdPyramid& pyramid,
                             const matching::CameraMotion& motion, const mapper::State& state) const;
  std::vector<const KeyImage*> viewsSeenAgain(const KeyImage& image, const mapper::State& state) const;
  double viewDistance(const KeyImage& from, const KeyImage& to, const mapper::State& state) const;
  /// Length of a motion in multiples of the length at which visual odometry takes another key frame. `depth`: median
  /// depth of the view [m].
  double viewDistance(const geometry::Se3& motion, double depth) const;
  bool wasLeft(const KeyImage& old, const map::KeyFrame& frame, const mapper::State& state) const;
  geometry::Se3 between(const KeyImage& from, const KeyImage& to, const mapper::State& state) const;
  mapper::RelativeMotion motionOf(const Link& link, const KeyImage& image, std::size_t links) const;
  matching::CameraMotion motionAt(const map::KeyFrame& frame, const geometry::Se3& base_from_camera,
                                  const mapper::State& state) const;
  void remember(KeyImage seen, const mapper::State& state);
  bool isElsewhere(const Return& one, const mapper::State& state) const;
  static mapper::Evidence elsewhereEvidence(std::size_t elsewhere, std::size_t all);
  mapper::Evidence missedEvidence() const;

  ViewLinksOptions options_;
  Camera camera_;
  matching::DenseMatcher matcher_;
  mapper::PluginContext context_;
  camera::LensStraightener lens_;
  std::string label_;             // of the camera; empty until its first image
  std::vector<KeyImage> recent_;  // in order of arrival, the newest last
  std::vector<KeyImage> views_;   // older images, each of a different view
  std::vector<Return> returns_;
  // How often the estimate had the camera back at a view that it had left, and how often the image did not fit then.
  std::size_t expected_ = 0, missed_ = 0;
};

}  // namespace omnimapper::plugins
