#include "Definition.h"

#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <sstream>

#include "Channel.h"

namespace omnimapper::ros {

namespace {

struct NamedPrimitive {
  const char* name;
  Primitive primitive;
};
constexpr std::array<NamedPrimitive, 17> kPrimitives{{{"bool", Primitive::boolean},
                                                      {"int8", Primitive::int8},
                                                      {"byte", Primitive::uint8},
                                                      {"char", Primitive::uint8},
                                                      {"uint8", Primitive::uint8},
                                                      {"octet", Primitive::uint8},
                                                      {"int16", Primitive::int16},
                                                      {"uint16", Primitive::uint16},
                                                      {"int32", Primitive::int32},
                                                      {"uint32", Primitive::uint32},
                                                      {"int64", Primitive::int64},
                                                      {"uint64", Primitive::uint64},
                                                      {"float32", Primitive::float32},
                                                      {"float64", Primitive::float64},
                                                      {"string", Primitive::text},
                                                      {"time", Primitive::time},
                                                      {"duration", Primitive::duration}}};

const NamedPrimitive* primitiveCalled(const std::string& name) {
  for (const auto& one : kPrimitives)
    if (name == one.name) return &one;
  return nullptr;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::size_t sizeOf(Primitive primitive) {
  switch (primitive) {
    case Primitive::boolean:
    case Primitive::int8:
    case Primitive::uint8:
      return 1;
    case Primitive::int16:
    case Primitive::uint16:
      return 2;
    case Primitive::int32:
    case Primitive::uint32:
    case Primitive::float32:
      return 4;
    case Primitive::text:
      return 0;
    default:
      return 8;
  }
}

class Definition::Parser {
 public:
  Parser(const std::string& type, const std::string& text, std::vector<std::unique_ptr<Layout>>& layouts)
      : layouts_(layouts) {
    if (text.size() > kLongest) throw BadDefinition("is longer than 1 MiB");
    std::istringstream lines(text);
    std::string current = type;
    for (std::string line; std::getline(lines, line);) {
      const std::string part = trimmed(line);
      if (part.rfind("MSG:", 0) == 0) current = standard(plainType(trimmed(part.substr(4))));
      auto& lines_of_type = lines_[current];
      if (part.rfind("MSG:", 0) != 0 && part.rfind("===", 0) != 0) lines_of_type.push_back(part);
    }
    lines_[type];
  }

  const Layout* layout(const std::string& type, int depth) {
    constexpr int kDeepest = 32;
    if (depth > kDeepest) throw BadDefinition("has " + type + " in itself");
    if (const auto made = made_.find(type); made != made_.end()) return made->second;
    const auto lines = lines_.find(type);
    if (lines == lines_.end()) throw BadDefinition("does not describe " + type);
    auto layout = std::make_unique<Layout>();
    layout->type = type;
    for (const auto& line : lines->second) addField(line, *layout, depth);
    layouts_.push_back(std::move(layout));
    return made_[type] = layouts_.back().get();
  }

 private:
  static constexpr std::size_t kLongest = std::size_t{1} << 20;

  // Bags of 2010 and before call the header by its older name.
  static std::string standard(const std::string& type) { return type == "roslib/Header" ? "std_msgs/Header" : type; }

  // "float32[] ranges  # [m]", "string<=10 name", "int32 KIND=3", "uint8 kind 1": only the first is a field, and the
  // second and last with a bound and a default.
  void addField(const std::string& text, Layout& layout, int depth) {
    std::istringstream words(text.substr(0, text.find('#')));
    std::string type, name, more;
    if (!(words >> type >> name)) return;
    const auto equals = name.find('=');
    if (equals != std::string::npos || (words >> more && more[0] == '=')) return;
    Field field;
    field.name = name;
    readCount(type, field);
    type = type.substr(0, type.find_first_of("[<"));
    if (type == "wstring") throw BadDefinition("has a text of wide characters");
    if (const auto* primitive = primitiveCalled(type))
      field.primitive = primitive->primitive;
    else
      field.message = layoutIn(type, layout.type, depth);
    layout.fields.push_back(field);
  }

  static void readCount(const std::string& type, Field& field) {
    const auto open = type.find('[');
    if (open == std::string::npos) return;
    const std::string inner = type.substr(open + 1, type.find(']') - open - 1);
    field.count = inner.empty() || inner[0] == '<' ? Field::Count::sequence : Field::Count::fixed;
    if (field.count == Field::Count::fixed &&
        std::from_chars(inner.data(), inner.data() + inner.size(), field.fixed_count).ec != std::errc())
      throw BadDefinition("has an array whose size is '" + inner + "'");
  }

  const Layout* layoutIn(const std::string& type, const std::string& outer, int depth) {
    if (type.find('/') != std::string::npos) return layout(standard(plainType(type)), depth + 1);
    const std::string sibling = outer.substr(0, outer.find('/') + 1) + type;
    return layout(type == "Header" && lines_.count(sibling) == 0 ? "std_msgs/Header" : sibling, depth + 1);
  }

  std::vector<std::unique_ptr<Layout>>& layouts_;
  std::map<std::string, std::vector<std::string>> lines_;  // by type
  std::map<std::string, const Layout*> made_;
};

Definition::Definition(const std::string& type, const std::string& text) {
  root_ = Parser(type, text, layouts_).layout(type, 0);
}

}  // namespace omnimapper::ros
