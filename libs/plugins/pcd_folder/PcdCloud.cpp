#include "PcdCloud.h"

#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <sstream>
#include <type_traits>

namespace omnimapper::source {

namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 24, kLongestRow = 1024;  // [bytes] of a point

struct Field {
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
  std::size_t offset = 0;  // [bytes] in a point
  std::size_t bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  std::size_t width = 0, height = 1, points = 0, row = 0;  // row: [bytes] of a point
  std::string data;
};

[[noreturn]] void refusePcd(const std::string& path, const std::string& reason) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": cannot be read as a PCD file: " + reason);
}

template <class Set>
void readEach(std::istringstream& line, std::vector<Field>& fields, const Set& set) {
  for (Field& field : fields) set(line, field);
}

void readHeaderLine(const std::string& text, Header& header) {
  std::istringstream line(text);
  std::string key;
  line >> key;
  if (key == "FIELDS") {
    for (std::string name; line >> name;) header.fields.push_back({name});
  } else if (key == "SIZE") {
    readEach(line, header.fields, [](auto& in, Field& field) { in >> field.size; });
  } else if (key == "TYPE") {
    readEach(line, header.fields, [](auto& in, Field& field) { in >> field.type; });
  } else if (key == "COUNT") {
    readEach(line, header.fields, [](auto& in, Field& field) { in >> field.count; });
  } else if (key == "WIDTH") {
    line >> header.width;
  } else if (key == "HEIGHT") {
    line >> header.height;
  } else if (key == "DATA") {
    line >> header.data;
  }
}

Header readHeader(std::istream& in, const std::string& path) {
  Header header;
  for (std::string line; header.data.empty() && std::getline(in, line);) readHeaderLine(line, header);
  if (header.data.empty()) refusePcd(path, "its header has no line DATA");
  for (Field& field : header.fields) {
    field.offset = header.row;
    const bool is_known = field.type == 'F' ? field.size == 4 || field.size == 8 : field.size <= 8;
    if (!is_known || field.count > kLongestRow)
      refusePcd(path, "the type and size of its field " + field.name + " are not known");
    header.row += field.bytes();
  }
  if (header.row > kLongestRow) refusePcd(path, "its points have more than 1024 bytes each");
  const bool fits =
      header.width <= kMostPoints && header.height <= kMostPoints && header.width * header.height <= kMostPoints;
  if (!fits) refusePcd(path, "it has more than 16777216 points");
  header.points = header.width * header.height;
  return header;
}

// LZF, by M. Lehmann: a control byte below 32 gives the number of literal bytes that follow, any other the length and
// the distance of earlier output that is repeated.
std::string decompressed(const std::string& from, std::size_t size, const std::string& path) {
  std::string to;  // grows with the data, as the size that the header states may be wrong
  std::size_t i = 0;
  const auto next = [&] {
    if (i >= from.size()) refusePcd(path, "its data ends too early; copy it again");
    return static_cast<std::size_t>(static_cast<unsigned char>(from[i++]));
  };
  while (to.size() < size && i < from.size()) {
    const std::size_t control = next();
    if (control < 32) {
      for (std::size_t k = 0; k <= control; ++k) to.push_back(static_cast<char>(next()));
      continue;
    }
    std::size_t length = control >> 5;
    if (length == 7) length += next();
    const std::size_t back = ((control & 31) << 8) + next() + 1;
    if (back > to.size()) refusePcd(path, "its data is damaged; copy it again");
    for (std::size_t k = 0; k < length + 2; ++k) to.push_back(to[to.size() - back]);
  }
  if (to.size() != size) refusePcd(path, "its data is damaged; copy it again");
  return to;
}

std::uint32_t readCount(std::istream& in) {
  std::uint32_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  return in ? count : 0;
}

/// The numbers of a cloud's points as they are in the file: point by point, or field by field.
class Numbers {
 public:
  Numbers(std::istream& in, const Header& header, const std::string& path) : header_(header) {
    const std::size_t size = header.points * header.row;
    if (header.data == "binary_compressed") {
      field_by_field_ = true;
      const std::uint32_t compressed = readCount(in), whole = readCount(in);
      if (whole != size) refusePcd(path, "the size of its data is not that of its points");
      bytes_ = decompressed(rest(in, compressed), size, path);
    } else if (header.data == "binary") {
      bytes_ = rest(in, size);
    } else if (header.data == "ascii") {
      readText(in);
    } else {
      refusePcd(path, "its data is '" + header.data + "', where ascii, binary or binary_compressed is expected");
    }
    if (bytes_.size() < size) refusePcd(path, "its data ends too early; copy it again");
  }

  /// The first number of a field, whatever its type.
  template <class Number>
  Number at(const Field& field, std::size_t point) const {
    const char* from = bytes_.data() + (field_by_field_ ? field.offset * header_.points + point * field.bytes()
                                                        : point * header_.row + field.offset);
    if (field.type == 'F') {
      const double number = field.size == 8 ? load<double>(from) : static_cast<double>(load<float>(from));
      if constexpr (std::is_integral_v<Number>) return static_cast<Number>(wholeOf(number));
      return static_cast<Number>(number);
    }
    std::uint64_t whole = 0;
    std::memcpy(&whole, from, field.size);
    return static_cast<Number>(whole);
  }
  /// The bits of a number of 4 bytes; PCL stores colours in the bits of a float.
  std::uint32_t bitsAt(const Field& field, std::size_t point) const {
    if (field.type != 'F') return at<std::uint32_t>(field, point);
    const auto number = at<float>(field, point);
    return load<std::uint32_t>(reinterpret_cast<const char*>(&number));
  }

 private:
  template <class Number>
  static Number load(const char* from) {
    Number number;
    std::memcpy(&number, from, sizeof number);
    return number;
  }

  static std::string rest(std::istream& in, std::size_t most) {
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (bytes.size() > most) bytes.resize(most);
    return bytes;
  }

  void readText(std::istream& in) {
    std::string word;
    for (std::size_t point = 0; point < header_.points; ++point) {
      for (const Field& field : header_.fields) {
        for (std::size_t k = 0; k < field.count && in >> word; ++k) append(field, word);
      }
    }
  }

  // The number as an integer; 0 if it is not finite or does not fit into 64 bits.
  static std::int64_t wholeOf(double number) {
    constexpr double kMost = 9223372036854775808.0;
    return number >= -kMost && number < kMost ? static_cast<std::int64_t>(number) : 0;
  }

  void append(const Field& field, const std::string& word) {
    const double number = std::strtod(word.c_str(), nullptr);
    char bytes[8] = {};
    const auto single = static_cast<float>(number);
    const auto whole = wholeOf(number);
    if (field.type != 'F') {
      std::memcpy(bytes, &whole, sizeof whole);
    } else if (field.size == 8) {
      std::memcpy(bytes, &number, sizeof number);
    } else {
      std::memcpy(bytes, &single, sizeof single);
    }
    bytes_.append(bytes, field.size);
  }

  const Header& header_;
  std::string bytes_;
  bool field_by_field_ = false;
};

const Field* fieldNamed(const Header& header, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    for (const Field& field : header.fields) {
      if (field.name == name && field.size > 0 && field.count > 0) return &field;
    }
  }
  return nullptr;
}

}  // namespace

PcdCloud readPcd(const std::string& path) {
  auto in = base::openInput(path, "PCD file");
  const Header header = readHeader(in, path);
  const Field *x = fieldNamed(header, {"x"}), *y = fieldNamed(header, {"y"}), *z = fieldNamed(header, {"z"});
  if (x == nullptr || y == nullptr || z == nullptr) refusePcd(path, "it lacks a field x, y or z");
  const Field *rgb = fieldNamed(header, {"rgb", "rgba"}), *label = fieldNamed(header, {"label"});
  const Numbers numbers(in, header, path);
  PcdCloud cloud;
  cloud.width = static_cast<int>(header.width);
  cloud.height = static_cast<int>(header.height);
  for (std::size_t i = 0; i < header.points; ++i) {
    cloud.x.push_back(numbers.at<float>(*x, i));
    cloud.y.push_back(numbers.at<float>(*y, i));
    cloud.z.push_back(numbers.at<float>(*z, i));
    if (rgb != nullptr) cloud.rgb.push_back(numbers.bitsAt(*rgb, i) & 0xFFFFFFU);
    if (label != nullptr) cloud.labels.push_back(numbers.at<std::uint32_t>(*label, i));
  }
  return cloud;
}

}  // namespace omnimapper::source
