#pragma once

#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>
#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/geometry/Se3.h>
#include <omnimapper/obs/Rgb.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::obs {

/// Functions to write and read the parts of this library's observations. Numbers keep their bits. As a file may be
/// damaged, reading allocates memory as data comes, never by what a count says.

using Archive = mrpt::serialization::CArchive;

/// Throws Error(damaged_input) for an object that a newer OmniMapper wrote.
[[noreturn]] void refuseVersion(const std::string& class_name, int version);

/// Reads exactly that many bytes; throws if the stream ends before.
void readBytes(Archive& in, void* bytes, std::size_t count);
std::vector<std::uint8_t> readBytes(Archive& in, std::size_t count);

void writeText(Archive& out, const std::string& text);
std::string readText(Archive& in);

/// Written as translation and rotation matrix, because the quaternion of MRPT's own format changes the last bits.
void writePose(Archive& out, const mrpt::poses::CPose3D& pose);
mrpt::poses::CPose3D readPose(Archive& in);
void writePose(Archive& out, const geometry::Se3& pose);
geometry::Se3 readSe3(Archive& in);

/// A whole number as 4 bytes.
void writeCount(Archive& out, std::size_t count);
std::uint32_t readCount(Archive& in);

template <class Number>
Number readNumber(Archive& in) {
  Number number;
  readBytes(in, &number, sizeof number);
  return number;
}

/// Writes a matrix row by row.
template <class Scalar, int rows, int columns>
void writeMatrix(Archive& out, const Eigen::Matrix<Scalar, rows, columns>& matrix) {
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) out << matrix(i, j);
}
template <class Matrix>
Matrix readMatrix(Archive& in) {
  Matrix matrix;
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j) matrix(i, j) = readNumber<typename Matrix::Scalar>(in);
  return matrix;
}

template <class Item, class Write>
void writeItems(Archive& out, const std::vector<Item>& items, const Write& write) {
  writeCount(out, items.size());
  for (const Item& item : items) write(out, item);
}
/// `read` must take at least one byte from the stream, so that a wrong count ends at the end of the stream.
template <class Read>
auto readItems(Archive& in, const Read& read) {
  const std::uint32_t count = readCount(in);
  std::vector<decltype(read(in))> items;
  items.reserve(std::min<std::uint32_t>(count, 64));
  for (std::uint32_t i = 0; i < count; ++i) items.push_back(read(in));
  return items;
}

/// A byte that is 1 where there is a value, then the value.
template <class Value, class Write>
void writeOptional(Archive& out, const std::optional<Value>& value, const Write& write) {
  out << static_cast<std::uint8_t>(value ? 1 : 0);
  if (value) write(out, *value);
}
template <class Read>
auto readOptional(Archive& in, const Read& read) -> std::optional<decltype(read(in))> {
  if (readNumber<std::uint8_t>(in) == 0) return std::nullopt;
  return read(in);
}

void writeColour(Archive& out, const Rgb& colour);
Rgb readColour(Archive& in);

void writePolygon(Archive& out, const geometry::Polygon3& polygon);
geometry::Polygon3 readPolygon(Archive& in);

}  // namespace omnimapper::obs
