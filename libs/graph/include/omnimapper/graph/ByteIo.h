#pragma once

#include <omnimapper/base/Id.h>

#include <Eigen/Core>
#include <cstdint>
#include <iosfwd>
#include <string>

namespace omnimapper::graph {

/// These functions write and read numbers and text as bytes, little-endian on every machine; doubles keep every bit.
/// The readers throw Error(damaged_input) if the stream ends early.
void writeUint(std::ostream& out, std::uint64_t value, int bytes);
void writeDouble(std::ostream& out, double value);
/// Writes the length (4 bytes), then the bytes.
void writeText(std::ostream& out, const std::string& text);

std::uint64_t readUint(std::istream& in, int bytes);
double readDouble(std::istream& in);
std::string readText(std::istream& in);

/// Writes the session (2 bytes), then the index (4 bytes).
template <class Tag>
void writeId(std::ostream& out, base::Id<Tag> id) {
  writeUint(out, id.session, 2);
  writeUint(out, id.index, 4);
}
template <class Id>
Id readId(std::istream& in) {
  Id id;
  id.session = static_cast<std::uint16_t>(readUint(in, 2));
  id.index = static_cast<std::uint32_t>(readUint(in, 4));
  return id;
}

/// Writes the numbers of a vector one after the other.
template <int Size>
void writeVector(std::ostream& out, const Eigen::Matrix<double, Size, 1>& vector) {
  for (const double number : vector) writeDouble(out, number);
}
template <int Size>
Eigen::Matrix<double, Size, 1> readVector(std::istream& in) {
  Eigen::Matrix<double, Size, 1> vector;
  for (double& number : vector) number = readDouble(in);
  return vector;
}

}  // namespace omnimapper::graph
