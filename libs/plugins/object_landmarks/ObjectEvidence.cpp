#include "ObjectEvidence.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/graph/ByteIo.h>

#include <algorithm>

namespace omnimapper::plugins {

namespace {

void writeTime(std::ostream& out, base::Stamp stamp) {
  graph::writeUint(out, static_cast<std::uint64_t>(stamp.time_since_epoch().count()), 8);
}

base::Stamp readTime(std::istream& in) {
  return base::Stamp(base::Duration(static_cast<std::int64_t>(graph::readUint(in, 8))));
}

// Of two stamps that may be invalid.
base::Stamp earlier(base::Stamp a, base::Stamp b) {
  return !base::isValid(a) ? b : !base::isValid(b) ? a : std::min(a, b);
}

void keepAfter(base::Stamp last_seen, std::vector<base::Stamp>& stamps) {
  std::sort(stamps.begin(), stamps.end());
  stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
  stamps.erase(stamps.begin(), std::upper_bound(stamps.begin(), stamps.end(), last_seen));
  if (stamps.size() > ObjectEvidence::kMostStamps)
    stamps.erase(stamps.begin(), stamps.end() - static_cast<std::ptrdiff_t>(ObjectEvidence::kMostStamps));
}

}  // namespace

void ObjectEvidence::add(Sight sight, base::Stamp stamp) {
  if (sight == Sight::unknown) return;
  last_looked = std::max(last_looked, stamp);
  if (sight == Sight::hidden) ++hidden_in;
  if (sight == Sight::absent) {
    ++absent_in;
    absent_at.push_back(stamp);
  }
  if (sight == Sight::seen) {
    ++seen_in;
    first_seen = earlier(first_seen, stamp);
    last_seen = std::max(last_seen, stamp);
  }
  keepAfter(last_seen, absent_at);
}

void ObjectEvidence::add(const ObjectEvidence& other) {
  seen_in += other.seen_in;
  hidden_in += other.hidden_in;
  absent_in += other.absent_in;
  first_seen = earlier(first_seen, other.first_seen);
  last_seen = std::max(last_seen, other.last_seen);
  last_looked = std::max(last_looked, other.last_looked);
  absent_at.insert(absent_at.end(), other.absent_at.begin(), other.absent_at.end());
  keepAfter(last_seen, absent_at);
}

bool ObjectEvidence::saysGone(int images, double seconds) const {
  return absent_at.size() >= static_cast<std::size_t>(images) &&
         base::secondsBetween(absent_at.front(), absent_at.back()) >= seconds;
}

void ObjectEvidence::write(std::ostream& out) const {
  for (const auto count : {seen_in, hidden_in, absent_in}) graph::writeUint(out, count, 4);
  for (const auto stamp : {first_seen, last_seen, last_looked}) writeTime(out, stamp);
  graph::writeUint(out, absent_at.size(), 1);
  for (const auto stamp : absent_at) writeTime(out, stamp);
}

ObjectEvidence ObjectEvidence::read(std::istream& in) {
  ObjectEvidence evidence;
  for (auto* count : {&evidence.seen_in, &evidence.hidden_in, &evidence.absent_in})
    *count = static_cast<std::uint32_t>(graph::readUint(in, 4));
  for (auto* stamp : {&evidence.first_seen, &evidence.last_seen, &evidence.last_looked}) *stamp = readTime(in);
  for (auto left = graph::readUint(in, 1); left > 0; --left) evidence.absent_at.push_back(readTime(in));
  const bool ordered = std::is_sorted(evidence.absent_at.begin(), evidence.absent_at.end());
  if (!ordered || evidence.absent_at.size() > kMostStamps)
    throw base::Error(base::ExitCode::unreadable_input,
                      "the images from which an object was absent are out of order or too many: damaged");
  return evidence;
}

}  // namespace omnimapper::plugins
