#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Bytes of small ONNX models, made without the usual libraries: messages of protocol buffers that are written by field
/// numbers (onnx.proto of ONNX 1.12).
namespace omnimapper::testing::onnx_bytes {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 128; value >>= 7) bytes += static_cast<char>((value & 127) | 128);
  return bytes + static_cast<char>(value);
}

inline std::string field(int number, std::uint64_t value) {
  return varint(number * 8) + varint(value);
}

inline std::string field(int number, const std::string& bytes) {
  return varint(number * 8 + 2) + varint(bytes.size()) + bytes;
}

/// An input or output of floats.
inline std::string value(const std::string& name, const std::vector<int>& shape) {
  std::string dims;
  for (const int size : shape) dims += field(1, field(1, size));
  return field(1, name) + field(2, field(1, field(1, 1) + field(2, dims)));
}

inline std::string weights(const std::string& name, const std::vector<int>& shape, const std::vector<float>& values) {
  std::string bytes, raw(values.size() * sizeof(float), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  for (const int size : shape) bytes += field(1, size);
  return bytes + field(2, 1) + field(8, name) + field(9, raw);
}

/// An attribute that is a list of integers.
inline std::string attribute(const std::string& name, const std::vector<int>& numbers) {
  std::string bytes = field(1, name);
  for (const int number : numbers) bytes += field(8, number);
  return bytes + field(20, 7);
}

inline std::string node(const std::string& operation, const std::vector<std::string>& inputs, const std::string& output,
                        const std::vector<std::string>& attributes = {}) {
  std::string bytes;
  for (const auto& input : inputs) bytes += field(1, input);
  bytes += field(2, output) + field(3, output) + field(4, operation);
  for (const auto& each : attributes) bytes += field(5, each);
  return bytes;
}

/// A model of messages that node(), weights() and value() made.
inline std::string model(const std::vector<std::string>& nodes, const std::vector<std::string>& initializers,
                         const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  std::string graph;
  for (const auto& each : nodes) graph += field(1, each);
  graph += field(2, std::string("graph"));
  for (const auto& each : initializers) graph += field(5, each);
  for (const auto& each : inputs) graph += field(11, each);
  for (const auto& each : outputs) graph += field(12, each);
  return field(1, 8) + field(7, graph) + field(8, field(2, 11));
}

}  // namespace omnimapper::testing::onnx_bytes
