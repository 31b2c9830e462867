#include "SignPayload.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/graph/ByteIo.h>
#include <omnimapper/graph/VariableKinds.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace omnimapper::plugins {

namespace {

constexpr std::uint64_t kVersion = 2;  // version 1 has no SignLook

using Votes = std::map<std::string, double>;

void add(Votes& votes, const Votes& others) {
  for (const auto& [text, weight] : others) votes[text] += weight;
}

// The text with the most votes; of several, the first in the alphabet.
const Votes::value_type* mostOf(const Votes& votes) {
  const auto most =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == votes.end() ? nullptr : &*most;
}

void write(std::ostream& out, const Votes& votes) {
  graph::writeUint(out, votes.size(), 4);
  for (const auto& [text, weight] : votes) {
    graph::writeText(out, text);
    graph::writeDouble(out, weight);
  }
}

Votes readVotes(std::istream& in) {
  Votes votes;
  for (auto left = graph::readUint(in, 4); left > 0; --left) {
    const std::string text = graph::readText(in);
    votes[text] = graph::readDouble(in);
  }
  return votes;
}

void write(std::ostream& out, const SignLook& look) {
  graph::writeId(out, look.frame);
  graph::writeVector(out, look.direction);
  graph::writeDouble(out, look.area_px);
  const map::Photograph none;
  const map::Photograph& photograph = look.photograph ? *look.photograph : none;
  graph::writeUint(out, static_cast<std::uint64_t>(photograph.width), 2);
  graph::writeUint(out, static_cast<std::uint64_t>(photograph.height), 2);
  graph::writeText(out, {photograph.rgb.begin(), photograph.rgb.end()});
}

SignLook readLook(std::istream& in) {
  SignLook look;
  look.frame = graph::readId<base::KeyFrameId>(in);
  look.direction = graph::readVector<3>(in);
  look.area_px = graph::readDouble(in);
  if (!(std::abs(look.direction.norm() - 1) < 1e-6) || !(look.area_px >= 0) || !std::isfinite(look.area_px))
    throw base::Error(base::ExitCode::unreadable_input,
                      "the largest view of a door sign has no valid direction or area: damaged");
  map::Photograph photograph;
  photograph.width = static_cast<int>(graph::readUint(in, 2));
  photograph.height = static_cast<int>(graph::readUint(in, 2));
  const std::string bytes = graph::readText(in);
  if (bytes.size() != std::size_t{3} * photograph.width * photograph.height)
    throw base::Error(base::ExitCode::unreadable_input,
                      "the number of pixels of a door sign's photograph does not match its size: damaged");
  if (bytes.empty()) return look;
  photograph.rgb.assign(bytes.begin(), bytes.end());
  look.photograph = std::make_shared<const map::Photograph>(std::move(photograph));
  return look;
}

}  // namespace

SignText SignPayload::text() const {
  constexpr double kShare = 0.5;
  SignText text;
  if (const auto* number = mostOf(numbers)) text.number = number->first;
  if (const auto* most = mostOf(words)) {
    for (const auto& [word, weight] : words)
      if (weight >= kShare * most->second) text.words.push_back(word);
  }
  return text;
}

std::string SignPayload::title() const {
  const SignText read = text();
  if (!read.number.empty()) return read.number;
  std::string title;
  for (const auto& word : read.words) title += (title.empty() ? "" : " ") + word;
  return title;
}

std::uint32_t SignPayload::measurements() const {
  std::uint32_t sum = 0;
  for (const auto& [label, measurements] : seen_by) sum += measurements;
  return sum;
}

std::shared_ptr<SignPayload> SignPayload::with(const SignText& text, const std::string& sensor_label) const {
  auto more = std::make_shared<SignPayload>(*this);
  if (!text.number.empty()) more->numbers[text.number] += text.confidence;
  for (const auto& word : text.words) more->words[word] += text.confidence;
  ++more->seen_by[sensor_label];
  return more;
}

std::shared_ptr<SignPayload> SignPayload::with(const SignPayload& other) const {
  auto both = std::make_shared<SignPayload>(*this);
  both->is_repeated = is_repeated || other.is_repeated;
  add(both->numbers, other.numbers);
  add(both->words, other.words);
  for (const auto& [label, measurements] : other.seen_by) both->seen_by[label] += measurements;
  if (other.best_look && isBetter(other.best_look->area_px)) both->best_look = other.best_look;
  return both;
}

std::shared_ptr<SignPayload> SignPayload::repeated() const {
  auto copy = std::make_shared<SignPayload>(*this);
  copy->is_repeated = true;
  return copy;
}

bool SignPayload::fits(const std::vector<std::string_view>& kinds) const {
  return kinds.size() == 1 && kinds[0] == graph::point3()->kind();
}

std::vector<base::KeyFrameId> SignPayload::keyFrames() const {
  return best_look ? std::vector{best_look->frame} : std::vector<base::KeyFrameId>();
}

map::LandmarkShape SignPayload::shape(const std::vector<Eigen::VectorXd>& values,
                                      const map::KeyFrames& key_frames) const {
  map::LandmarkShape shape;
  if (values.empty()) return shape;
  shape.label = "sign";
  shape.caption = title();
  shape.points.emplace_back(values.front());
  if (best_look) {
    shape.photograph = best_look->photograph;
    if (const auto* frame = key_frames.find(best_look->frame)) {
      // Signs hang upright, and the look with the largest area is roughly from the front.
      Eigen::Vector3d back = geometry::fromMrpt(frame->map_from_base).rotation * -best_look->direction;
      back.z() = 0;
      if (back.norm() > 0.1) shape.normal = back.normalized();
    }
  }
  const SignText read = text();
  if (!read.number.empty()) shape.properties.push_back({"number", read.number});
  std::string lines;
  for (const auto& word : read.words) lines += (lines.empty() ? "" : ", ") + word;
  if (!lines.empty()) shape.properties.push_back({"words", lines});
  if (is_repeated) shape.properties.push_back({"repeated_elsewhere", true});
  for (const auto& [label, measurements] : seen_by) shape.addSeenBy(label, measurements);
  return shape;
}

void SignPayload::write(std::ostream& out) const {
  graph::writeUint(out, kVersion, 1);
  plugins::write(out, numbers);
  plugins::write(out, words);
  graph::writeUint(out, is_repeated, 1);
  graph::writeUint(out, seen_by.size(), 4);
  for (const auto& [label, measurements] : seen_by) {
    graph::writeText(out, label);
    graph::writeUint(out, measurements, 4);
  }
  graph::writeUint(out, best_look.has_value(), 1);
  if (best_look) plugins::write(out, *best_look);
}

void SignPayload::addTo(map::PayloadRegistry& registry) {
  registry.add("door_sign", [](std::istream& in) {
    const auto version = graph::readUint(in, 1);
    if (version > kVersion) {
      throw base::Error(base::ExitCode::unreadable_input,
                        "a door sign of version " + std::to_string(version) + ": this program reads versions up to " +
                            std::to_string(kVersion) + "; take the OmniMapper that wrote the map");
    }
    auto payload = std::make_shared<SignPayload>();
    payload->numbers = readVotes(in);
    payload->words = readVotes(in);
    payload->is_repeated = graph::readUint(in, 1) != 0;
    for (auto left = graph::readUint(in, 4); left > 0; --left) {
      const std::string label = graph::readText(in);
      payload->seen_by[label] = static_cast<std::uint32_t>(graph::readUint(in, 4));
    }
    if (version > 1 && graph::readUint(in, 1) != 0) payload->best_look = readLook(in);
    return payload;
  });
}

}  // namespace omnimapper::plugins
