#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/base/Exceptions.h>
#include <omnimapper/base/WorkerPool.h>
#include <omnimapper/map/MapFile.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>

#include "SectionBytes.h"

namespace omnimapper::map {

namespace {

const std::string kFramesName = "frames";
// Version 2 also stores whether the reference sensor saw something at a key frame. Version 3 also has the clouds of
// depth images, and its bytes are in compressed blocks, so that a reader needs only one block in memory at a time.
constexpr std::uint32_t kFramesVersion = 3;
constexpr std::size_t kBlock = std::size_t{1} << 20;  // smallest size of a block [bytes]; a block has whole key frames

// CPose3D keeps a rotation matrix: angles or a quaternion would be rounded, and a map that is saved twice would differ.
void writePose(ByteWriter& out, const mrpt::poses::CPose3D& pose) {
  for (int i = 0; i < 3; ++i) out.real(pose[i]);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out.real(pose.getRotationMatrix()(row, column));
  }
}

mrpt::poses::CPose3D readPose(ByteReader& in) {
  mrpt::math::CVectorFixedDouble<3> translation;
  for (int i = 0; i < 3; ++i) translation[i] = in.real();
  mrpt::math::CMatrixDouble33 rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation(row, column) = in.real();
  }
  return mrpt::poses::CPose3D(rotation, translation);
}

void writeObservation(ByteWriter& out, const mrpt::obs::CObservation& observation) {
  mrpt::io::CMemoryStream memory;
  mrpt::serialization::archiveFrom(memory) << observation;
  out.block({static_cast<const char*>(memory.getRawBufferData()), memory.getTotalBytesCount()});
}

mrpt::obs::CObservation::ConstPtr readObservation(ByteReader& in) {
  const std::string_view bytes = in.block();
  mrpt::serialization::CSerializable::Ptr object;
  try {
    mrpt::io::CMemoryStream memory;
    memory.assignMemoryNotOwn(bytes.data(), bytes.size());
    object = mrpt::serialization::archiveFrom(memory).ReadObject();
  } catch (const std::exception& error) {
    refuse(kFramesName,
           "an observation cannot be read; load the library that has its class. MRPT says: " + base::sentenceOf(error));
  }
  auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
  if (!observation) refuse(kFramesName, "has an object of another kind where an observation should be");
  return observation;
}

void writeFrame(ByteWriter& out, const KeyFrame& frame) {
  writeId(out, frame.id);
  writeStamp(out, frame.stamp);
  writeId(out, frame.pose);
  writePose(out, frame.map_from_base);
  writePose(out, frame.keyframe_from_next);
  out.uint(frame.dependents.size(), 4);
  for (const DependentFrame& dependent : frame.dependents) {
    writeStamp(out, dependent.stamp);
    writePose(out, dependent.keyframe_from_base);
  }
  out.uint(frame.observations.size(), 4);
  for (const auto& observation : frame.observations) writeObservation(out, *observation);
  out.uint(frame.reference, 1);
  out.uint(frame.cloud.size(), 4);
  for (const CloudPoint& point : frame.cloud) {
    for (const std::int16_t coordinate : {point.x, point.y, point.z})
      out.uint(static_cast<std::uint16_t>(coordinate), 2);
    for (const std::uint8_t colour : {point.red, point.green, point.blue}) out.uint(colour, 1);
  }
}

CloudPoint readCloudPoint(ByteReader& in) {
  CloudPoint point;
  for (std::int16_t* coordinate : {&point.x, &point.y, &point.z}) *coordinate = static_cast<std::int16_t>(in.uint(2));
  for (std::uint8_t* colour : {&point.red, &point.green, &point.blue}) *colour = static_cast<std::uint8_t>(in.uint(1));
  return point;
}

// All but what was observed.
KeyFrame readHead(ByteReader& in) {
  KeyFrame frame;
  frame.id = readId<base::KeyFrameTag>(in);
  frame.stamp = readStamp(in);
  frame.pose = readId<base::VariableTag>(in);
  frame.map_from_base = readPose(in);
  frame.keyframe_from_next = readPose(in);
  for (std::uint64_t left = in.uint(4); left > 0; --left) {
    const base::Stamp stamp = readStamp(in);
    frame.dependents.push_back({stamp, readPose(in)});
  }
  return frame;
}

KeyFrame readFrame(ByteReader& in, std::uint32_t version) {
  KeyFrame frame = readHead(in);
  for (std::uint64_t left = in.uint(4); left > 0; --left) frame.observations.push_back(readObservation(in));
  frame.reference = version == 1 || in.uint(1) != 0;
  if (version >= 3) {
    for (std::uint64_t left = in.uint(4); left > 0; --left) frame.cloud.push_back(readCloudPoint(in));
  }
  return frame;
}

// A key frame without its observations and its cloud, which are skipped.
KeyFrame readBareFrame(ByteReader& in, std::uint32_t version) {
  constexpr std::uint64_t kBytesOfPoint = 9;
  KeyFrame frame = readHead(in);
  for (std::uint64_t left = in.uint(4); left > 0; --left) in.block();
  frame.reference = version == 1 || in.uint(1) != 0;
  if (version >= 3) in.raw(in.uint(4) * kBytesOfPoint);
  bool is_finite = frame.map_from_base.getRotationMatrix().asEigen().allFinite();
  for (int i = 0; i < 3; ++i) is_finite = is_finite && std::isfinite(frame.map_from_base[i]);
  if (!is_finite) refuse(kFramesName, "has a pose that is not finite: the file is damaged");
  return frame;
}

// Reads each key frame of a section by `read`.
template <class Read>
auto readAll(const MapSection& section, Read read) {
  expectSection(section, kFramesName, kFramesVersion);
  ByteReader in(section.bytes, placeOf(kFramesName));
  std::uint64_t left = in.uint(4);
  std::vector<decltype(read(in, section.version))> all;
  if (section.version < 3) {
    for (; left > 0; --left) all.push_back(read(in, section.version));
  }
  while (left > 0) {
    const std::string block = readCompressed(in);
    ByteReader of_block(block, placeOf(kFramesName));
    for (; left > 0 && !of_block.atEnd(); --left) all.push_back(read(of_block, section.version));
    expectEnd(of_block, kFramesName);
  }
  expectEnd(in, kFramesName);
  return all;
}

// The file has the key frames in the order in which they were driven; they are inserted in the order of ids.
Map mapOf(std::vector<KeyFrame> frames) {
  std::sort(frames.begin(), frames.end(), [](const KeyFrame& a, const KeyFrame& b) { return a.id < b.id; });
  Map map;
  try {
    for (KeyFrame& frame : frames) map.key_frames.insert(std::move(frame));
  } catch (const base::Error& error) {
    refuse(kFramesName, std::string(error.what()) + ": the file is damaged");
  }
  return map;
}

}  // namespace

MapSection framesToSection(const Map& map) {
  ByteWriter out, frames;
  out.uint(map.key_frames.size(), 4);
  // Compression takes most of the time, so workers do it, a few blocks behind, and the order of blocks is kept.
  constexpr int kThreads = 2;
  constexpr std::size_t kBehind = 4;
  std::deque<std::future<std::string>> waiting;
  base::WorkerPool workers(kThreads);
  const auto compress = [&] {
    waiting.push_back(workers.submit<std::string>([bytes = frames.take()] { return compressed(bytes); }));
  };
  const auto take = [&] {
    out.raw(waiting.front().get());
    waiting.pop_front();
  };
  for (const KeyFrame& frame : map.key_frames) {
    writeFrame(frames, frame);
    if (frames.bytes().size() >= kBlock) compress();
    if (waiting.size() > kBehind) take();
  }
  if (!frames.bytes().empty()) compress();
  while (!waiting.empty()) take();
  return {kFramesName, kFramesVersion, out.take()};
}

std::uint64_t uncompressedSize(const MapSection& frames) {
  if (frames.version < 3) return frames.bytes.size();
  ByteReader in(frames.bytes, placeOf(kFramesName));
  std::uint64_t size = 0;
  try {
    in.uint(4);
    while (!in.atEnd()) {
      const std::uint64_t stated = in.uint(8);
      size += std::min(stated, kMostPerByte * in.block().size());
    }
  } catch (const base::Error&) {
  }
  return size;
}

Map framesFromSection(const MapSection& section) {
  return mapOf(readAll(section, readFrame));
}

Map bareFramesFromSection(const MapSection& section) {
  auto frames = readAll(section, readBareFrame);
  if (frames.empty()) refuse(kFramesName, "has no key frame");
  return mapOf(std::move(frames));
}

std::vector<FramePose> framePosesFromSection(const MapSection& section) {
  const auto frames = readAll(section, readBareFrame);
  if (frames.empty()) refuse(kFramesName, "has no key frame");
  std::vector<FramePose> poses;
  for (const auto& frame : frames) poses.push_back({frame.id, frame.map_from_base});
  return poses;
}

}  // namespace omnimapper::map
