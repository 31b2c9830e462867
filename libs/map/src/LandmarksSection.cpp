#include <omnimapper/map/MapFile.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {

const std::string kLandmarksName = "landmarks";
constexpr std::uint32_t kLandmarksVersion = 1;
// Unused ids take memory. If a file has more of them than this in all sessions, plus this many for each landmark, it is
// damaged.
constexpr std::uint64_t kMaxHoles = 1'000'000, kMaxHolesPerLandmark = 1000, kBytesOfId = 6;

void writePayload(ByteWriter& out, const LandmarkPayload* payload) {
  out.uint(payload != nullptr, 1);
  if (!payload) return;
  std::ostringstream bytes;
  payload->write(bytes);
  out.block(payload->kind());
  out.block(bytes.str());
}

std::shared_ptr<const LandmarkPayload> readPayload(ByteReader& in, const PayloadRegistry& payloads) {
  if (in.uint(1) == 0) return nullptr;
  const std::string kind(in.block()), bytes(in.block());
  return payloads.read(kind, bytes);
}

void writeLandmark(ByteWriter& out, const Landmark& landmark) {
  out.block(landmark.kind);
  out.block(landmark.owner);
  out.uint(landmark.variables.size(), 4);
  for (const base::VariableId id : landmark.variables) writeId(out, id);
  writePayload(out, landmark.payload.get());
  out.uint(landmark.evidence, 4);
  writeStamp(out, landmark.first_seen);
  writeStamp(out, landmark.last_seen);
  out.uint(static_cast<std::uint64_t>(landmark.state), 1);
  writeId(out, landmark.merged_into);
}

Landmark readLandmark(ByteReader& in, base::LandmarkId id, const PayloadRegistry& payloads) {
  Landmark landmark;
  landmark.id = id;
  landmark.kind = in.block();
  landmark.owner = in.block();
  for (std::uint64_t left = in.uint(4); left > 0; --left) landmark.variables.push_back(readId<base::VariableTag>(in));
  landmark.payload = readPayload(in, payloads);
  landmark.evidence = static_cast<std::uint32_t>(in.uint(4));
  landmark.first_seen = readStamp(in);
  landmark.last_seen = readStamp(in);
  const std::uint64_t state = in.uint(1);
  if (state > static_cast<std::uint64_t>(Landmark::State::merged)) {
    refuse(kLandmarksName, "landmark " + toString(id) + " is in an unknown state: the file is damaged");
  }
  landmark.state = static_cast<Landmark::State>(state);
  landmark.merged_into = readId<base::LandmarkTag>(in);
  return landmark;
}

void skipPayload(ByteReader& in) {
  if (in.uint(1) == 0) return;
  in.block();
  in.block();
}

// The landmark that it was merged into; none if it was not merged.
std::optional<base::LandmarkId> readMerge(ByteReader& in) {
  in.block();
  in.block();
  for (std::uint64_t left = in.uint(4); left > 0; --left) readId<base::VariableTag>(in);
  skipPayload(in);
  in.uint(4);
  readStamp(in);
  readStamp(in);
  const bool is_merged = in.uint(1) == static_cast<std::uint64_t>(Landmark::State::merged);
  const auto into = readId<base::LandmarkTag>(in);
  return is_merged ? std::optional(into) : std::nullopt;
}

}  // namespace

// The section has the next index of each session, so that no index is used twice, then the landmarks in the order of
// ids.
MapSection landmarksToSection(const Map& map) {
  ByteWriter out;
  const auto next = map.landmarks.nextIndices();
  out.uint(next.size(), 4);
  for (const auto& [session, index] : next) writeId(out, base::LandmarkId{session, index});
  out.uint(map.landmarks.size(), 4);
  for (const auto& [id, landmark] : map.landmarks) {
    writeId(out, id);
    writeLandmark(out, landmark);
  }
  return {kLandmarksName, kLandmarksVersion, out.take()};
}

base::IdTable<base::LandmarkId, Landmark> landmarksFromSection(const MapSection& section,
                                                               const PayloadRegistry& payloads) {
  expectSection(section, kLandmarksName, kLandmarksVersion);
  ByteReader in(section.bytes, placeOf(kLandmarksName));
  std::map<std::uint16_t, std::uint32_t> next;
  for (std::uint64_t left = in.uint(4); left > 0; --left) {
    const auto id = readId<base::LandmarkTag>(in);
    next[id.session] = id.index;
  }
  std::uint64_t left = in.uint(4), given = 0;
  for (const auto& [session, index] : next) given += index;
  // Each landmark begins with its id, so the size of the section limits their number.
  if (given > kMaxHoles + kMaxHolesPerLandmark * std::min(left, section.bytes.size() / kBytesOfId)) {
    refuse(kLandmarksName, "its sessions report " + std::to_string(given) +
                               " used ids, too many for its landmarks: the file is damaged");
  }
  base::IdTable<base::LandmarkId, Landmark> table;
  const auto skipTo = [&](base::LandmarkId id) {
    const std::uint32_t at = table.nextId(id.session).index;
    const auto end = next.find(id.session);
    if (end == next.end() || id.index > end->second || id.index < at) {
      refuse(kLandmarksName, "id " + toString(id) + " is out of order: the file is damaged");
    }
    while (table.nextId(id.session).index < id.index) table.skip(id.session);
  };
  for (; left > 0; --left) {
    const auto id = readId<base::LandmarkTag>(in);
    skipTo(id);
    table.add(id.session, readLandmark(in, id, payloads));
  }
  for (const auto& [session, index] : next) skipTo({session, index});
  expectEnd(in, kLandmarksName);
  return table;
}

std::map<base::LandmarkId, base::LandmarkId> currentLandmarks(const MapSection& section) {
  expectSection(section, kLandmarksName, kLandmarksVersion);
  ByteReader in(section.bytes, placeOf(kLandmarksName));
  for (std::uint64_t left = in.uint(4); left > 0; --left) readId<base::LandmarkTag>(in);
  std::map<base::LandmarkId, base::LandmarkId> current;
  for (std::uint64_t left = in.uint(4); left > 0; --left) {
    const auto id = readId<base::LandmarkTag>(in);
    current[id] = readMerge(in).value_or(id);
  }
  expectEnd(in, kLandmarksName);
  // A landmark may be merged into one that was merged itself.
  for (auto& each : current) {
    std::size_t steps = 0;
    for (auto next = current.find(each.second); next != current.end() && next->second != each.second;
         next = current.find(each.second)) {
      each.second = next->second;
      if (++steps > current.size())
        refuse(kLandmarksName, "a landmark is merged into itself by way of others: the file is damaged");
    }
  }
  return current;
}

}  // namespace omnimapper::map
