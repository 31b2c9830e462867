#include "Value.h"

#include <omnimapper/base/Bytes.h>

#include <algorithm>
#include <cstring>

namespace omnimapper::ros {

namespace {

std::uint64_t bitsIn(const char* bytes, std::size_t size, bool is_swapped) {
  if (!is_swapped) return base::fromBytes(bytes, static_cast<int>(size));
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) bits = (bits << 8) | static_cast<unsigned char>(bytes[i]);
  return bits;
}

std::int64_t signExtended(std::uint64_t bits, std::size_t size) {
  const auto shift = static_cast<int>(64 - 8 * size);
  return static_cast<std::int64_t>(bits << shift) >> shift;
}

bool isReal(Primitive primitive) {
  return primitive == Primitive::float32 || primitive == Primitive::float64;
}

double realOf(std::uint64_t bits, Primitive primitive) {
  if (primitive == Primitive::float64) return base::fromBits(bits);
  const auto narrow = static_cast<std::uint32_t>(bits);
  float value = 0;
  std::memcpy(&value, &narrow, sizeof value);
  return static_cast<double>(value);
}

std::int64_t integerOf(std::uint64_t bits, Primitive primitive) {
  switch (primitive) {
    case Primitive::int8:
    case Primitive::int16:
    case Primitive::int32:
      return signExtended(bits, sizeOf(primitive));
    default:
      return static_cast<std::int64_t>(bits);
  }
}

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

}  // namespace

void Value::refuse(const std::string& what) const {
  throw BadBytes((name_ ? "has a field " + *name_ + " that " : "is a message that ") + what);
}

const Value::Parts& Value::parts() const {
  const auto* parts = std::get_if<Parts>(&content_);
  if (!parts) refuse("has no parts");
  return *parts;
}

bool Value::has(std::string_view name) const {
  const auto* parts = std::get_if<Parts>(&content_);
  return parts && parts->layout &&
         std::any_of(parts->layout->fields.begin(), parts->layout->fields.end(),
                     [&](const Field& field) { return field.name == name; });
}

const Value& Value::operator[](std::string_view name) const {
  const Parts& all = parts();
  if (all.layout) {
    for (std::size_t i = 0; i < all.values.size(); ++i)
      if (all.layout->fields[i].name == name) return all.values[i];
  }
  refuse("has no field " + std::string(name));
}

const Value& Value::operator[](std::size_t index) const {
  const Parts& all = parts();
  if (index >= all.values.size()) refuse("has too few elements");
  return all.values[index];
}

double Value::number() const {
  if (const auto* real = std::get_if<double>(&content_)) return *real;
  return static_cast<double>(integer());
}

std::int64_t Value::integer() const {
  const auto* whole = std::get_if<std::int64_t>(&content_);
  if (!whole) refuse("is no whole number");
  return *whole;
}

std::string_view Value::text() const {
  const auto* text = std::get_if<std::string_view>(&content_);
  if (!text) refuse("is no text");
  return *text;
}

std::int64_t Value::nanoseconds() const {
  if (has("sec")) {
    constexpr std::int64_t kMost = std::int64_t{1} << 32;
    const std::int64_t seconds = std::clamp((*this)["sec"].integer(), -kMost, kMost);
    return seconds * kNanosecondsPerSecond + std::clamp(either("nanosec", "nsec").integer(), -kMost, kMost);
  }
  return integer();
}

std::size_t Value::size() const {
  if (const auto* array = std::get_if<Array>(&content_)) return array->bytes.size() / sizeOf(array->primitive);
  return parts().values.size();
}

double Value::number(std::size_t index) const {
  const auto* array = std::get_if<Array>(&content_);
  if (!array) refuse("is no array of numbers");
  const std::size_t size = sizeOf(array->primitive);
  if (index >= array->bytes.size() / size) refuse("has too few elements");
  const std::uint64_t bits = bitsIn(array->bytes.data() + index * size, size, array->is_swapped);
  return isReal(array->primitive) ? realOf(bits, array->primitive)
                                  : static_cast<double>(integerOf(bits, array->primitive));
}

bool Value::isListOfMessages() const {
  const auto* parts = std::get_if<Parts>(&content_);
  return parts && !parts->layout;
}

std::string_view Value::bytes() const {
  const auto* array = std::get_if<Array>(&content_);
  if (!array || sizeOf(array->primitive) != 1) refuse("is no array of bytes");
  return array->bytes;
}

Eigen::Vector3d Value::vector() const {
  return {(*this)["x"].number(), (*this)["y"].number(), (*this)["z"].number()};
}

/// Reads the values of one message.
class Decoder {
 public:
  Decoder(std::string_view bytes, Encoding encoding) : cursor_(bytes), is_cdr_(encoding == Encoding::cdr) {
    if (!is_cdr_) return;
    const auto head = cursor_.raw(4);
    const unsigned kind = static_cast<unsigned char>(head[1]);
    if (head[0] != 0 || (kind != 0 && kind != 1 && kind != 6 && kind != 7))
      throw BadBytes("is serialized in a way that is not known");
    is_swapped_ = kind == 0 || kind == 6;
    largest_alignment_ = kind >= 6 ? 4 : 8;
  }

  Value message(const Layout& layout) {
    Value value;
    auto& parts = value.content_.emplace<Value::Parts>();
    parts.layout = &layout;
    parts.values.reserve(layout.fields.size());
    for (const Field& field : layout.fields) {
      parts.values.push_back(fieldOf(field));
      parts.values.back().name_ = &field.name;
    }
    if (is_cdr_ && layout.fields.empty()) cursor_.raw(1);  // a struct of DDS is not empty
    return value;
  }

 private:
  Value fieldOf(const Field& field) {
    countValue();
    if (field.count == Field::Count::one) return one(field);
    const std::uint64_t count = field.count == Field::Count::fixed ? field.fixed_count : number(4);
    if (!field.message && field.primitive != Primitive::text) return array(field.primitive, count);
    Value value;
    auto& parts = value.content_.emplace<Value::Parts>();
    if (count > cursor_.left() && count > kMostEmpty) throw BadBytes("ends too early");
    for (std::uint64_t i = 0; i < count; ++i) {
      countValue();
      parts.values.push_back(one(field));
    }
    return value;
  }

  void countValue() {
    constexpr std::size_t kMostValues = 4'000'000;
    if (++values_ > kMostValues) throw BadBytes("has more than 4 million values");
  }

  Value one(const Field& field) {
    if (field.message) return message(*field.message);
    Value value;
    if (field.primitive == Primitive::text) {
      value.content_ = text();
    } else if (field.primitive == Primitive::time || field.primitive == Primitive::duration) {
      const bool is_time = field.primitive == Primitive::time;
      const std::uint64_t seconds = number(4), nanoseconds = number(4);
      const auto whole = is_time ? static_cast<std::int64_t>(seconds) : signExtended(seconds, 4);
      const auto rest = is_time ? static_cast<std::int64_t>(nanoseconds) : signExtended(nanoseconds, 4);
      value.content_ = whole * kNanosecondsPerSecond + rest;
    } else {
      const std::uint64_t bits = number(sizeOf(field.primitive));
      if (isReal(field.primitive))
        value.content_ = realOf(bits, field.primitive);
      else
        value.content_ = integerOf(bits, field.primitive);
    }
    return value;
  }

  Value array(Primitive primitive, std::uint64_t count) {
    const std::size_t size = sizeOf(primitive);
    if (count > cursor_.left() / size) throw BadBytes("ends too early");
    if (count > 0) align(primitive == Primitive::time || primitive == Primitive::duration ? 4 : size);
    Value value;
    value.content_ = Value::Array{primitive, cursor_.raw(count * size), is_swapped_};
    return value;
  }

  std::string_view text() {
    std::string_view text = cursor_.raw(number(4));
    if (is_cdr_ && !text.empty() && text.back() == '\0') text.remove_suffix(1);
    return text;
  }

  std::uint64_t number(std::size_t size) {
    align(size);
    return bitsIn(cursor_.raw(size).data(), size, is_swapped_);
  }

  // CDR places numbers at multiples of their size, counted after the four bytes of the head.
  void align(std::size_t size) {
    if (!is_cdr_) return;
    const std::size_t unit = std::min(size, largest_alignment_), over = (cursor_.position() - 4) % unit;
    if (over != 0) cursor_.raw(unit - over);
  }

  static constexpr std::uint64_t kMostEmpty = 1000;  // elements of an array that may have no bytes
  ByteCursor cursor_;
  bool is_cdr_, is_swapped_ = false;
  std::size_t largest_alignment_ = 8;
  std::size_t values_ = 0;
};

Value decoded(const Layout& layout, std::string_view bytes, Encoding encoding) {
  return Decoder(bytes, encoding).message(layout);
}

}  // namespace omnimapper::ros
