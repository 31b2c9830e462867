#include "Fields.h"

#include <omnimapper/base/Error.h>

namespace omnimapper::obs {

void refuseVersion(const std::string& class_name, int version) {
  throw base::Error(base::ExitCode::damaged_input,
                    class_name + " of version " + std::to_string(version) +
                        " is newer than this program; read it with the version of OmniMapper that wrote it.");
}

void readBytes(Archive& in, void* bytes, std::size_t count) {
  auto* at = static_cast<char*>(bytes);
  // MRPT returns fewer bytes if fewer are left, and throws if none are.
  while (count > 0) {
    const std::size_t read = in.ReadBuffer(at, count);
    at += read;
    count -= read;
  }
}

std::vector<std::uint8_t> readBytes(Archive& in, std::size_t count) {
  constexpr std::size_t piece = 1 << 16;
  std::vector<std::uint8_t> bytes;
  while (bytes.size() < count) {
    const std::size_t begin = bytes.size(), length = std::min(piece, count - begin);
    bytes.resize(begin + length);
    readBytes(in, bytes.data() + begin, length);
  }
  return bytes;
}

void writeText(Archive& out, const std::string& text) {
  writeCount(out, text.size());
  if (!text.empty()) out.WriteBuffer(text.data(), text.size());
}

std::string readText(Archive& in) {
  const auto bytes = readBytes(in, readCount(in));
  return std::string(bytes.begin(), bytes.end());
}

void writePose(Archive& out, const mrpt::poses::CPose3D& pose) {
  const auto& rotation = pose.getRotationMatrix();
  for (int i = 0; i < 3; ++i) out << pose.m_coords[i];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out << rotation(i, j);
}

mrpt::poses::CPose3D readPose(Archive& in) {
  mrpt::math::CVectorFixedDouble<3> translation;
  mrpt::math::CMatrixDouble33 rotation;
  for (int i = 0; i < 3; ++i) translation[i] = readNumber<double>(in);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = readNumber<double>(in);
  return mrpt::poses::CPose3D(rotation, translation);
}

void writePose(Archive& out, const geometry::Se3& pose) {
  writeMatrix(out, pose.translation);
  out << pose.rotation.w() << pose.rotation.x() << pose.rotation.y() << pose.rotation.z();
}

geometry::Se3 readSe3(Archive& in) {
  geometry::Se3 pose;
  pose.translation = readMatrix<Eigen::Vector3d>(in);
  pose.rotation.w() = readNumber<double>(in);
  pose.rotation.vec() = readMatrix<Eigen::Vector3d>(in);
  return pose;
}

void writeCount(Archive& out, std::size_t count) {
  if (count > UINT32_MAX)
    throw base::Error(base::ExitCode::internal, "an observation has more than 2^32 parts, which cannot be written");
  out << static_cast<std::uint32_t>(count);
}

std::uint32_t readCount(Archive& in) {
  return readNumber<std::uint32_t>(in);
}

void writeColour(Archive& out, const Rgb& colour) {
  out << colour.red << colour.green << colour.blue;
}

Rgb readColour(Archive& in) {
  Rgb colour;
  colour.red = readNumber<std::uint8_t>(in);
  colour.green = readNumber<std::uint8_t>(in);
  colour.blue = readNumber<std::uint8_t>(in);
  return colour;
}

void writePolygon(Archive& out, const geometry::Polygon3& polygon) {
  writeItems(out, polygon.vertices, writeMatrix<double, 3, 1>);
}

geometry::Polygon3 readPolygon(Archive& in) {
  return {readItems(in, readMatrix<Eigen::Vector3d>)};
}

}  // namespace omnimapper::obs
