#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace omnimapper::ros {

/// A type that the languages of ROS 1 and 2 have built in. `time` and `duration` are those of ROS 1.
enum class Primitive {
  boolean,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  text,
  time,
  duration
};

/// Bytes of a serialized number; 0 for a text.
std::size_t sizeOf(Primitive primitive);

struct Layout;

/// A field of a message.
struct Field {
  enum class Count { one, fixed, sequence };
  std::string name;
  Primitive primitive = Primitive::boolean;
  const Layout* message = nullptr;  ///< not null: the field is a message, and `primitive` means nothing
  Count count = Count::one;
  std::size_t fixed_count = 0;
};

/// The fields of a type of messages, in the order in which they are serialized.
struct Layout {
  std::string type;
  std::vector<Field> fields;
};

/// A definition that cannot be followed, with the reason as a clause whose subject is the definition.
class BadDefinition : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The layout of a type and of all types in it, read from the text of its definition: its own fields, and after each
/// line of equals signs those of another type ("MSG: std_msgs/Header").
class Definition {
 public:
  /// Throws BadDefinition: for a type that is not described, that contains itself, or that has a wide text.
  Definition(const std::string& type, const std::string& text);
  const Layout& layout() const { return *root_; }

 private:
  class Parser;
  std::vector<std::unique_ptr<Layout>> layouts_;
  const Layout* root_ = nullptr;
};

/// The definition of a common type, for logs without definitions: that of ROS 2. Empty if the type is not known.
std::string usualDefinition(const std::string& type);

}  // namespace omnimapper::ros
