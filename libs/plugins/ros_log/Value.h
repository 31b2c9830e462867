#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ByteCursor.h"
#include "Definition.h"

namespace omnimapper::ros {

/// A field of a message as its definition describes it: a number, a text, an array of numbers, an array of messages or
/// texts, or a message. Refers to the message's bytes. All functions throw BadBytes, which names the field, if the
/// field is missing or of another kind.
class Value {
 public:
  /// A field of a message.
  const Value& operator[](std::string_view name) const;
  bool has(std::string_view name) const;
  /// The first of two names that there is, as ROS 1 and ROS 2 differ: "K" or "k".
  const Value& either(std::string_view name, std::string_view other) const {
    return has(name) ? (*this)[name] : (*this)[other];
  }

  double number() const;
  std::int64_t integer() const;
  std::string_view text() const;
  /// A time or a duration [ns], of ROS 1 or 2.
  std::int64_t nanoseconds() const;

  /// Elements of an array.
  std::size_t size() const;
  /// A number of an array.
  double number(std::size_t index) const;
  /// A message or text of an array.
  const Value& operator[](std::size_t index) const;
  /// Whether this is an array of messages or texts, not of numbers.
  bool isListOfMessages() const;
  /// The bytes of an array of bytes.
  std::string_view bytes() const;

  /// A message with x, y and z.
  Eigen::Vector3d vector() const;

 private:
  friend class Decoder;
  struct Array {
    Primitive primitive;
    std::string_view bytes;
    bool is_swapped;
  };
  struct Parts {
    const Layout* layout = nullptr;  // of a message; null for an array
    std::vector<Value> values;
  };
  [[noreturn]] void refuse(const std::string& what) const;
  const Parts& parts() const;

  const std::string* name_ = nullptr;
  std::variant<std::int64_t, double, std::string_view, Array, Parts> content_ = std::int64_t{0};
};

/// How messages are serialized.
enum class Encoding { ros1, cdr };

/// Decodes a message. Throws BadBytes if the bytes end too early, or there are more values than any message has.
/// `cdr` is the XCDR1 of DDS, in either order of bytes, or XCDR2 without what makes types extensible.
Value decoded(const Layout& layout, std::string_view bytes, Encoding encoding);

}  // namespace omnimapper::ros
