#include "omnimapper/graph/ByteIo.h"

#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>

#include <istream>
#include <ostream>

namespace omnimapper::graph {

namespace {

void readBytes(std::istream& in, char* bytes, std::size_t count) {
  if (!in.read(bytes, static_cast<std::streamsize>(count)))
    throw base::Error(base::ExitCode::damaged_input,
                      "graph: the data ends in the middle of a record: the file was cut short; use an intact copy");
}

}  // namespace

void writeUint(std::ostream& out, std::uint64_t value, int bytes) {
  char buffer[8];
  base::toBytes(value, bytes, buffer);
  out.write(buffer, bytes);
}

void writeDouble(std::ostream& out, double value) {
  writeUint(out, base::bitsOf(value), 8);
}

void writeText(std::ostream& out, const std::string& text) {
  writeUint(out, text.size(), 4);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

std::uint64_t readUint(std::istream& in, int bytes) {
  char buffer[8];
  readBytes(in, buffer, static_cast<std::size_t>(bytes));
  return base::fromBytes(buffer, bytes);
}

double readDouble(std::istream& in) {
  return base::fromBits(readUint(in, 8));
}

std::string readText(std::istream& in) {
  // The text is read in pieces, so that a damaged length reaches the end of the stream before it exhausts the memory.
  std::uint64_t left = readUint(in, 4);
  std::string text;
  while (left > 0) {
    const std::size_t piece = left < 65536 ? left : 65536, start = text.size();
    text.resize(start + piece);
    readBytes(in, text.data() + start, piece);
    left -= piece;
  }
  return text;
}

}  // namespace omnimapper::graph
