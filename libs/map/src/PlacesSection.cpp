#include <omnimapper/map/Places.h>

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

void write(ByteWriter& out, const Place& place) {
  writeId(out, place.id);
  out.block(place.kind);
  out.block(place.label);
  out.block(place.caption);
  writeList(out, place.properties, [&](const auto& property) {
    out.block(property.first);
    out.block(property.second);
  });
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

Place readPlace(ByteReader& in) {
  Place place;
  place.id = readId<base::LandmarkTag>(in);
  place.kind = in.block();
  place.label = in.block();
  place.caption = in.block();
  readList(in, [&] {
    const std::string name(in.block());
    place.properties.emplace_back(name, in.block());
  });
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
  readList(in, [&] { read.places.push_back(readPlace(in)); });
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
