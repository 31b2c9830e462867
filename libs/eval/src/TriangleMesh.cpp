#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/eval/TriangleMesh.h>

#include <cmath>
#include <map>
#include <sstream>

namespace omnimapper::eval {

namespace {

[[noreturn]] void refuseMesh(const std::string& path, const std::string& why) {
  throw base::Error(base::ExitCode::unreadable_input, path + ": " + why);
}

/// A property of an element: a scalar, or a list with the type of its length.
struct Property {
  std::string name;
  int bytes = 0;
  bool is_real = false;
  int length_bytes = 0;  // 0: a scalar
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::string& path)
      : path_(path), bytes_(base::readInput(path, "PLY file")), body_(afterHeader(), path) {}

  TriangleMesh read() {
    for (const Element& element : elements_) {
      if (element.properties.empty()) continue;
      for (std::uint64_t i = 0; i < element.count; ++i) {
        const std::map<std::string, double> values = readItem(element);
        if (element.name == "vertex") addVertex(values);
      }
    }
    for (const auto& triangle : mesh_.triangles) {
      for (const int corner : triangle) {
        if (corner < 0 || corner >= static_cast<int>(mesh_.vertices.size()))
          refuseMesh(path_, "a face has the corner " + std::to_string(corner) + ", but there are " +
                                std::to_string(mesh_.vertices.size()) + " vertices");
      }
    }
    return std::move(mesh_);
  }

 private:
  // Reads the header and returns what follows it.
  std::string_view afterHeader() {
    constexpr std::string_view kEnd = "end_header\n";
    const auto end = bytes_.find(kEnd);
    if (bytes_.rfind("ply", 0) != 0 || end == std::string::npos)
      refuseMesh(path_, "is no PLY file with a whole header");
    std::istringstream header(bytes_.substr(0, end));
    bool is_binary = false;
    for (std::string line; std::getline(header, line);) {
      std::istringstream words(line);
      std::string keyword, format;
      words >> keyword;
      if (keyword == "format") is_binary = (words >> format) && format == "binary_little_endian";
      if (keyword == "element") addElement(words);
      if (keyword == "property") addProperty(words);
    }
    if (!is_binary) refuseMesh(path_, "is not in the format binary_little_endian; convert it");
    return std::string_view(bytes_).substr(end + kEnd.size());
  }

  void addElement(std::istringstream& words) {
    Element element;
    if (!(words >> element.name >> element.count)) refuseMesh(path_, "has an element without a count");
    elements_.push_back(std::move(element));
  }

  void addProperty(std::istringstream& words) {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      words >> type;
      property.length_bytes = sizeOf(type);
      words >> type;
    }
    property.bytes = sizeOf(type);
    property.is_real = type.rfind("float", 0) == 0 || type == "double";
    if (!(words >> property.name) || elements_.empty())
      refuseMesh(path_, "has a property without a name or an element");
    elements_.back().properties.push_back(std::move(property));
  }

  int sizeOf(const std::string& type) const {
    static const std::map<std::string, int> sizes{{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                                  {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                                  {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                                  {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = sizes.find(type);
    if (found == sizes.end()) refuseMesh(path_, "has a property of the unknown type '" + type + "'");
    return found->second;
  }

  // The scalars of the next item by their names. Lists of faces are added to the mesh.
  std::map<std::string, double> readItem(const Element& element) {
    std::map<std::string, double> values;
    for (const Property& property : element.properties) {
      if (property.length_bytes == 0)
        values[property.name] = readNumber(property);
      else
        readList(element, property);
    }
    return values;
  }

  double readNumber(const Property& property) {
    const std::uint64_t bits = body_.uint(property.bytes);
    if (!property.is_real) return static_cast<double>(bits);
    if (property.bytes == 8) return base::fromBits(bits);
    const auto half = static_cast<std::uint32_t>(bits);
    float value;
    std::memcpy(&value, &half, sizeof value);
    return static_cast<double>(value);
  }

  void readList(const Element& element, const Property& property) {
    const std::uint64_t length = body_.uint(property.length_bytes);
    const bool are_corners = element.name == "face" && property.name.rfind("vertex_ind", 0) == 0;
    if (are_corners && (length != 3 || property.is_real))
      refuseMesh(path_, "has a face of " + std::to_string(length) + " corners; only triangles can be read");
    std::array<int, 3> corners{};
    for (std::uint64_t i = 0; i < length; ++i) {
      const std::uint64_t number = body_.uint(property.bytes);
      if (are_corners) corners[i] = static_cast<int>(static_cast<std::uint32_t>(number));
    }
    if (are_corners) mesh_.triangles.push_back(corners);
  }

  void addVertex(const std::map<std::string, double>& values) {
    Eigen::Vector3d vertex;
    for (int i = 0; i < 3; ++i) {
      const auto found = values.find(std::string(1, "xyz"[i]));
      if (found == values.end() || !std::isfinite(found->second))
        refuseMesh(path_, "has a vertex without finite coordinates x, y and z");
      vertex[i] = found->second;
    }
    mesh_.vertices.push_back(vertex);
  }

  std::string path_, bytes_;
  std::vector<Element> elements_;
  base::ByteReader body_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh readTriangleMesh(const std::string& path) {
  return PlyReader(path).read();
}

}  // namespace omnimapper::eval
