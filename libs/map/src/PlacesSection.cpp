#include <omnimapper/map/Places.h>

#include <charconv>
#include <cmath>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {

// Flags for the optional parts that follow.
constexpr std::uint64_t kMoved = 1, kNormal = 2, kSeenFrom = 4, kSigma = 8, kAlongNormal = 16, kAllFlags = 31;

[[noreturn]] void refuseValue(const std::string& what) {
  refuse(Places::kLayer, what + ": the file is damaged. Take another copy of it, or map its log again.");
}

template <int N>
void write(ByteWriter& out, const Eigen::Matrix<double, N, 1>& point) {
  for (int i = 0; i < N; ++i) out.real(point[i]);
}

double readFinite(ByteReader& in) {
  const double value = in.real();
  if (!std::isfinite(value)) refuseValue("has a number that is not finite");
  return value;
}

template <int N>
Eigen::Matrix<double, N, 1> read(ByteReader& in) {
  Eigen::Matrix<double, N, 1> point;
  for (int i = 0; i < N; ++i) point[i] = readFinite(in);
  return point;
}

Eigen::Vector3d readDirection(ByteReader& in) {
  constexpr double kOff = 1e-6;
  const auto direction = read<3>(in);
  if (!(std::abs(direction.norm() - 1) < kOff)) refuseValue("has a direction that is not a unit vector");
  return direction;
}

template <class List, class Write>
void writeList(ByteWriter& out, const List& list, Write write_one) {
  out.uint(list.size(), 4);
  for (const auto& item : list) write_one(item);
}

template <class Read>
void readList(ByteReader& in, Read read_one) {
  for (auto left = in.uint(4); left > 0; --left) read_one();
}

using PointList = std::vector<Eigen::Vector2d>;

void write(ByteWriter& out, const PointList& points) {
  writeList(out, points, [&](const Eigen::Vector2d& point) { write<2>(out, point); });
}

PointList readPoints(ByteReader& in) {
  PointList points;
  readList(in, [&] { points.push_back(read<2>(in)); });
  return points;
}

void write(ByteWriter& out, const Extent& extent) {
  write(out, extent.points);
  writeList(out, extent.lines, [&](const auto& line) {
    write<2>(out, line.first);
    write<2>(out, line.second);
  });
  writeList(out, extent.outlines, [&](const PointList& points) { write(out, points); });
  writeList(out, extent.holes, [&](const PointList& points) { write(out, points); });
  out.real(extent.bottom);
  out.real(extent.top);
}

Extent readExtent(ByteReader& in) {
  Extent extent;
  extent.points = readPoints(in);
  readList(in, [&] {
    const auto from = read<2>(in);
    extent.lines.emplace_back(from, read<2>(in));
  });
  readList(in, [&] { extent.outlines.push_back(readPoints(in)); });
  readList(in, [&] { extent.holes.push_back(readPoints(in)); });
  extent.bottom = readFinite(in);
  extent.top = readFinite(in);
  return extent;
}

// The kinds of values of properties, by the index in Property::Value.
enum PropertyKind : std::uint64_t { kText, kCount, kMeasure, kFlag, kTime };

void write(ByteWriter& out, const Property& property) {
  out.block(property.name);
  out.uint(property.value.index(), 1);
  if (const auto* text = std::get_if<std::string>(&property.value)) out.block(*text);
  if (const auto* count = std::get_if<std::uint64_t>(&property.value)) out.uint(*count, 8);
  if (const auto* measure = std::get_if<Measure>(&property.value)) {
    out.real(measure->value);
    out.block(measure->unit);
  }
  if (const auto* flag = std::get_if<bool>(&property.value)) out.uint(*flag ? 1 : 0, 1);
  if (const auto* stamp = std::get_if<base::Stamp>(&property.value)) writeStamp(out, *stamp);
}

Property readProperty(ByteReader& in) {
  Property property{std::string(in.block()), {}};
  switch (in.uint(1)) {
    case kText:
      property.value = std::string(in.block());
      break;
    case kCount:
      property.value = in.uint(8);
      break;
    case kMeasure: {
      const double value = readFinite(in);
      property.value = Measure{value, std::string(in.block())};
      break;
    }
    case kFlag:
      property.value = in.uint(1) != 0;
      break;
    case kTime:
      property.value = readStamp(in);
      break;
    default:
      refuseValue("has a property of an unknown kind");
  }
  return property;
}

// Version 1 had texts alone; the end of the name said what the text was.
Property readOldProperty(ByteReader& in) {
  const std::string name(in.block()), text(in.block());
  if (text == "yes" || text == "no") return {name, text == "yes"};
  const auto underscore = name.rfind('_');
  const std::string end = underscore == std::string::npos ? "" : name.substr(underscore + 1);
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(number)) return {name, text};
  constexpr double kMost = 1e15, kLatest = 9e9;  // a larger count, and a later second of Unix time, stays a text
  if ((end == "measurements" || end == "sightings") && number >= 0 && number < kMost)
    return {name, static_cast<std::uint64_t>(number)};
  for (const char* unit : {"m", "m2", "m3", "deg", "s", "kg"})
    if (end == unit) return {name.substr(0, underscore), Measure{number, unit}};
  if (end == "seen" && number >= 0 && number < kLatest) return {name, base::stampFromUnix(number)};
  return {name, text};
}

void write(ByteWriter& out, const Place& place) {
  writeId(out, place.id);
  out.block(place.kind);
  out.block(place.label);
  out.block(place.caption);
  writeList(out, place.properties, [&](const Property& property) { write(out, property); });
  write<3>(out, place.position);
  write(out, place.extent);
  out.uint(place.measurements, 4);
  writeList(out, place.seen_by, [&](const auto& sensor) {
    out.block(sensor.first);
    out.uint(sensor.second, 8);
  });
  writeStamp(out, place.first_seen);
  writeStamp(out, place.last_seen);
  out.uint((place.moved ? kMoved : 0) | (place.normal ? kNormal : 0) | (place.seen_from ? kSeenFrom : 0) |
               (place.sigma ? kSigma : 0) | (place.sigma_is_along_normal ? kAlongNormal : 0),
           1);
  if (place.normal) write<3>(out, *place.normal);
  if (place.seen_from) write<3>(out, *place.seen_from);
  if (place.sigma) out.real(*place.sigma);
}

Place readPlace(ByteReader& in, std::uint32_t version) {
  Place place;
  place.id = readId<base::LandmarkTag>(in);
  place.kind = in.block();
  place.label = in.block();
  place.caption = in.block();
  readList(in, [&] { place.properties.push_back(version == 1 ? readOldProperty(in) : readProperty(in)); });
  place.position = read<3>(in);
  place.extent = readExtent(in);
  place.measurements = static_cast<std::uint32_t>(in.uint(4));
  readList(in, [&] {
    const std::string label(in.block());
    place.seen_by[label] = in.uint(8);
  });
  place.first_seen = readStamp(in);
  place.last_seen = readStamp(in);
  const std::uint64_t flags = in.uint(1);
  if (flags > kAllFlags) refuseValue("has a landmark with unknown parts");
  place.moved = (flags & kMoved) != 0;
  place.sigma_is_along_normal = (flags & kAlongNormal) != 0;
  if ((flags & kNormal) != 0) place.normal = readDirection(in);
  if ((flags & kSeenFrom) != 0) place.seen_from = readDirection(in);
  if ((flags & kSigma) != 0) {
    place.sigma = readFinite(in);
    if (*place.sigma < 0) refuseValue("has a standard deviation below zero");
  }
  return place;
}

}  // namespace

std::string Places::toBytes() const {
  ByteWriter out;
  writeList(out, places, [&](const Place& place) { write(out, place); });
  out.uint(last_pose ? 1 : 0, 1);
  if (last_pose) {
    for (const double value : {last_pose->x, last_pose->y, last_pose->yaw}) out.real(value);
    writeStamp(out, last_pose->stamp);
    out.uint(last_pose->session, 2);
  }
  return out.take();
}

Places Places::fromSection(const MapSection& section) {
  expectSection(section, kLayer, kLayerVersion);
  ByteReader in(section.bytes, placeOf(kLayer));
  Places read;
  readList(in, [&] { read.places.push_back(readPlace(in, section.version)); });
  if (in.uint(1) != 0) {
    LastPose pose;
    for (double* value : {&pose.x, &pose.y, &pose.yaw}) *value = readFinite(in);
    pose.stamp = readStamp(in);
    pose.session = static_cast<std::uint16_t>(in.uint(2));
    read.last_pose = pose;
  }
  expectEnd(in, kLayer);
  return read;
}

}  // namespace omnimapper::map
