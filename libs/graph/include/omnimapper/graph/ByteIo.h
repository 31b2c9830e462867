#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

namespace omnimapper::graph {

/// Numbers and text as bytes, little-endian whatever the machine; doubles keep every bit.
/// The readers throw Error(damaged_input) where the stream ends early.
void writeUint(std::ostream& out, std::uint64_t value, int bytes);
void writeDouble(std::ostream& out, double value);
/// Length (4 bytes), then the bytes.
void writeText(std::ostream& out, const std::string& text);

std::uint64_t readUint(std::istream& in, int bytes);
double readDouble(std::istream& in);
std::string readText(std::istream& in);

}  // namespace omnimapper::graph
