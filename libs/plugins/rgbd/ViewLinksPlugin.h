#pragma once

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/matching/DenseMatcher.h>
#include <omnimapper/matching/RgbdTracker.h>
#include <omnimapper/perception/LensStraightener.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

struct ViewLinksOptions {
  std::string odometry = "visual_odometry";  ///< section whose camera, matching and shutters hold here, too
  int key_frames_back = 3;                   ///< links to the second before a key frame up to this one
  int old_views = 2;                         ///< links of a key frame to older views, at most
  int stored_views = 500;                    ///< older views that are kept; then the oldest goes
  double overlap = 0.5;                      ///< share of an older view that is still seen, at least
  double loss_scale = 1;                     ///< [standard deviations] from which on a link counts less

  static const base::OptionTable<ViewLinksOptions>& table();
};

/// Registers the image of each key frame with those of key frames before it: with the second, third, ... before it
/// (thesis 4.1.2: links to x-1, x-2 and x-3; that to x-1 is the odometry's), and with older ones whose view it should
/// have again by the estimate, which closes loops as far as drift is small. Thus what drifted is spread over the way,
/// where odometry alone takes it out at once.
///
/// An image that cannot be read is left out. Links of one key frame share its image, and are not independent: n of them
/// have n times their covariance, and so count together as one. Links to views of longer before act once the
/// consistency test has accepted them.
class ViewLinksPlugin : public mapper::MeasurementPlugin {
 public:
  /// `camera`: its label; empty for the first that comes.
  ViewLinksPlugin(const ViewLinksOptions& options, const std::string& camera,
                  const matching::RgbdTrackerOptions& tracking, const matching::DenseMatcherOptions& matching,
                  const mapper::PluginContext& context);

  bool wants(const mrpt::obs::CObservation& observation) const override;
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override;
  void retired(const map::KeyFrame& frame) override;
  /// What share of the time lies between two views of one place, where drift would be seen, in the place of the
  /// odometry's, which looks at its own key frames alone; how many returns the finished map has elsewhere than the
  /// images; and how often the estimate had the camera at a view that the image did not show.
  std::vector<mapper::Evidence> evidence(const mapper::View& view) const override;

 private:
  /// The image of a key frame.
  struct Seen {
    base::KeyFrameId frame;
    std::shared_ptr<const matching::DenseReference> reference;
    geometry::Se3 base_from_camera;
    double depth;                 // [m] median
    geometry::Vector6d velocity;  // of the camera, in its frame [m/s] [rad/s]
  };
  /// One that an image was registered with.
  struct Link {
    const Seen* to;
    matching::DenseMatch match;
    bool is_old = false;     // to a view of longer before
    bool is_return = false;  // which the camera left in between
  };
  /// A view that was left and came back, as its images have it.
  struct Return {
    base::KeyFrameId before, frame;
    geometry::Se3 before_from_camera, before_base_from_camera, base_from_camera;
    double depth;  // [m] median
  };
  mapper::Batch linksOf(const map::KeyFrame& frame, const mrpt::obs::CObservation3DRangeScan& scan,
                        const mapper::View& view);
  std::optional<Link> linkTo(const Seen& to, const Seen& image, const matching::RgbdPyramid& pyramid,
                             const matching::CameraMotion& motion, const mapper::State& state) const;
  std::vector<const Seen*> viewsSeenAgain(const Seen& image, const mapper::State& state) const;
  double farness(const Seen& from, const Seen& to, const mapper::State& state) const;
  /// Of a motion in the distances from which on visual odometry takes another key frame; depth [m].
  double farness(const geometry::Se3& motion, double depth) const;
  bool wasLeft(const Seen& old, const map::KeyFrame& frame, const mapper::State& state) const;
  geometry::Se3 between(const Seen& from, const Seen& to, const mapper::State& state) const;
  mapper::RelativeMotion motionOf(const Link& link, const Seen& image, std::size_t links) const;
  matching::CameraMotion motionAt(const map::KeyFrame& frame, const geometry::Se3& base_from_camera,
                                  const mapper::State& state) const;
  void remember(Seen seen, const mapper::State& state);
  bool isElsewhere(const Return& one, const mapper::State& state) const;
  static mapper::Evidence elsewhereEvidence(std::size_t elsewhere, std::size_t all);
  mapper::Evidence missedEvidence() const;

  ViewLinksOptions options_;
  std::string camera_;  // label; empty: the first that comes
  matching::RgbdTrackerOptions tracking_;
  matching::DenseMatcher matcher_;
  mapper::PluginContext context_;
  perception::LensStraightener lens_;
  std::string label_;         // empty until the first comes
  std::vector<Seen> recent_;  // in the order they came, the newest last
  std::vector<Seen> views_;   // older ones, each of another view
  std::vector<Return> returns_;
  // How often the estimate had the camera back at a view that it had left, and how often the image did not fit.
  std::size_t expected_ = 0, missed_ = 0;
};

class ViewLinksPluginFactory : public mapper::MeasurementPluginFactory {
  DEFINE_MRPT_OBJECT(ViewLinksPluginFactory, omnimapper::plugins)
 public:
  std::string name() const override { return "ViewLinksPlugin"; }
  std::string summary() const override {
    return "Links key frames by their depth images: each to several before it, and to views that are seen again.";
  }
  const std::vector<base::OptionSpec>& options() const override;
  std::unique_ptr<mapper::MeasurementPlugin> make(const base::ConfigSection& section,
                                                  const mapper::PluginContext& context) const override;
};

}  // namespace omnimapper::plugins
