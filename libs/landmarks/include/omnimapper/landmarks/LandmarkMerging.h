#pragma once

#include <omnimapper/plugin/Batch.h>
#include <omnimapper/plugin/View.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::landmarks {

/// Why two landmarks are one.
struct Sameness {
  double chi2;      ///< of the difference between the two
  double limit;     ///< the largest chi2 that the test accepts
  std::string why;  ///< an addition to the decision's reason; may be empty
};

/// The decision, at the newest key frame, that two landmarks are the same.
mapper::Decision mergeDecision(const mapper::View& view, const std::string& section, base::LandmarkId kept,
                               base::LandmarkId gone, const Sameness& sameness);

/// Collects the landmarks that are merged together, with a decision for each merge and the payloads of those that stay.
/// `Payload::with(const Payload&)` returns a copy that has the measurements of another landmark, too.
template <class Payload>
class LandmarkMerging {
 public:
  using Payloads = std::map<base::LandmarkId, std::shared_ptr<const Payload>>;

  /// `section`: INI section of the plugin. Both must outlive this object.
  LandmarkMerging(const mapper::View& view, const std::string& section) : view_(view), section_(section) {}

  /// Whether `gone` may be merged into `kept`: the relative pose of their sessions is known, neither has been merged
  /// away, and nothing has been merged into `gone`.
  bool mayMerge(base::LandmarkId kept, base::LandmarkId gone) const {
    return gone_.count(kept) == 0 && gone_.count(gone) == 0 && parts_.count(gone) == 0 &&
           view_.areAligned(kept.session, gone.session);
  }
  void merge(base::LandmarkId kept, base::LandmarkId gone, const Sameness& sameness) {
    merge(kept, gone, sameness, payloadOf(kept).with(payloadOf(gone)));
  }
  /// The same for a payload without such a function; `both`: the payload with the measurements of both.
  void merge(base::LandmarkId kept, base::LandmarkId gone, const Sameness& sameness,
             std::shared_ptr<const Payload> both) {
    payloads_[kept] = std::move(both);
    merges_.emplace_back(kept, gone);
    parts_[kept].push_back(gone);
    gone_.insert(gone);
    batch_.log(mergeDecision(view_, section_, kept, gone, sameness));
  }

  /// Those that have been merged into a landmark, in the order of the merges.
  const std::vector<base::LandmarkId>& partsOf(base::LandmarkId kept) const {
    static const std::vector<base::LandmarkId> none;
    const auto found = parts_.find(kept);
    return found == parts_.end() ? none : found->second;
  }
  /// The payload with those of all parts.
  const Payload& payloadOf(base::LandmarkId id) const {
    const auto found = payloads_.find(id);
    return found != payloads_.end() ? *found->second : dynamic_cast<const Payload&>(*view_.map.landmark(id).payload);
  }
  bool isGone(base::LandmarkId id) const { return gone_.count(id) > 0; }
  /// Payloads of the landmarks that have parts.
  const Payloads& payloads() const { return payloads_; }
  /// Replaces the payload of a landmark, whether or not it has parts.
  void describe(base::LandmarkId id, std::shared_ptr<const Payload> payload) {
    if (const auto found = payloads_.find(id); found != payloads_.end()) {
      found->second = std::move(payload);
    } else {
      batch_.describeLandmark(id, std::move(payload));
    }
  }

  /// For further edits that go with the merges.
  mapper::Batch& batch() { return batch_; }
  /// All edits. To be called once, at the end.
  mapper::Batch take() {
    for (const auto& [kept, gone] : merges_) batch_.mergeLandmarks(gone, kept, payloads_.at(kept));
    return std::move(batch_);
  }

 private:
  const mapper::View& view_;
  const std::string& section_;
  std::vector<std::pair<base::LandmarkId, base::LandmarkId>> merges_;  // kept, gone
  std::set<base::LandmarkId> gone_;
  std::map<base::LandmarkId, std::vector<base::LandmarkId>> parts_;
  Payloads payloads_;
  mapper::Batch batch_;
};

}  // namespace omnimapper::landmarks
