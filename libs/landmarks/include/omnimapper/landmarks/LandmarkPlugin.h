#pragma once

#include <omnimapper/plugin/MeasurementPlugin.h>

#include <cstddef>
#include <utility>

namespace omnimapper::landmarks {

/// A measurement plugin with the life cycle of landmarks: its `Index` (a LandmarkIndex) knows the landmarks of the map,
/// those of a map that is continued included; landmarks that turn out to be one are merged after each solve and at the
/// end of the log. In a map that is held, nothing is merged.
template <class Index>
class LandmarkPlugin : public mapper::MeasurementPlugin {
 public:
  mapper::Batch measure(const map::KeyFrame& frame, const mapper::Observed& observed,
                        const mapper::View& view) override {
    known_.update(view);
    return associate(frame, observed, view);
  }
  void applied(const mapper::AppliedBatch& ids) override {
    for (const auto id : ids.landmarks) known_.add(id);
  }
  mapper::FollowUp afterCommit(const map::KeyFrame& /*frame*/, const mapper::View& view) override {
    if (view.map_is_held || view.solves.size() == merged_at_solve_) return {};
    merged_at_solve_ = view.solves.size();
    known_.update(view);
    return {merge(view), {}};
  }
  mapper::Batch atEnd(const mapper::View& view) override {
    if (view.map_is_held) return {};
    known_.update(view);
    return finish(view);
  }
  void restore(const map::MapSection* /*saved*/, const mapper::View& view) override { known_.restore(view); }

 protected:
  explicit LandmarkPlugin(Index known) : known_(std::move(known)) {}

  /// The edits for one observation; most types let a LandmarkAssociator make them.
  virtual mapper::Batch associate(const map::KeyFrame& frame, const mapper::Observed& observed,
                                  const mapper::View& view) = 0;
  /// Merges landmarks that are one (LandmarkMerging). By default there are none, as where a sensor tells them apart.
  virtual mapper::Batch merge(const mapper::View& /*view*/) { return {}; }
  /// The edits at the end of the log.
  virtual mapper::Batch finish(const mapper::View& view) { return merge(view); }

  Index& known() { return known_; }
  const Index& known() const { return known_; }

 private:
  Index known_;
  std::size_t merged_at_solve_ = 0;
};

}  // namespace omnimapper::landmarks
