#include "truePoses.h"

#include <algorithm>
#include <iterator>

#include "Converted.h"

namespace omnimapper::ros {

namespace {
bool isEarlier(const std::pair<base::Stamp, geometry::Se3>& a, const std::pair<base::Stamp, geometry::Se3>& b) {
  return a.first < b.first;
}
}  // namespace

source::TruePoses truePosesOf(const std::string& topic, MessageReader& reader, const Channels& channels,
                              ChannelDecoder& decoder, const Plan& plan) {
  source::TruePoses poses;
  while (const auto message = reader.next()) {
    if (channels[message->channel].topic != topic) continue;
    const auto value = decoder.decode(*message);
    if (!value) continue;
    try {
      const Header header = headerOf(*value);
      const std::string frame = value->has("child_frame_id") ? frameIn((*value)["child_frame_id"]) : header.frame;
      poses.emplace_back(stampOf(plan.timeOf({topic, frame}, header.time, message->time)), innerPoseOf(*value));
    } catch (const BadBytes&) {  // a pose that is not valid
    }
  }
  reader.rewind();
  std::stable_sort(poses.begin(), poses.end(), isEarlier);
  return poses;
}

std::optional<geometry::Se3> poseAt(const source::TruePoses& poses, base::Stamp stamp) {
  constexpr double kLargestGap = 0.2;  // [s]
  const auto after = std::lower_bound(poses.begin(), poses.end(), std::pair(stamp, geometry::Se3()), isEarlier);
  if (after == poses.end()) return std::nullopt;
  if (after->first == stamp) return after->second;
  if (after == poses.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap = base::secondsBetween(before->first, after->first);
  if (gap > kLargestGap) return std::nullopt;
  const double share = base::secondsBetween(before->first, stamp) / gap;
  return geometry::Se3{before->second.rotation.slerp(share, after->second.rotation).normalized(),
                       before->second.translation + share * (after->second.translation - before->second.translation)};
}

}  // namespace omnimapper::ros
