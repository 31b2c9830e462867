#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::grid {

/// The keys and values of a YAML file of map_server; other elements of YAML are not supported. All functions throw
/// Error(unreadable_input), naming file and key.
class MapServerYaml {
 public:
  explicit MapServerYaml(const std::string& file);

  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& otherwise) const;
  double number(const std::string& key, double least, double most) const;
  double number(const std::string& key, double least, double most, double otherwise) const;
  /// The numbers of "[a, b, c]".
  std::vector<double> numbers(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void addLine(const std::string& line);
  double checked(const std::string& key, std::optional<double> value, double least, double most) const;

  std::string file_;
  std::map<std::string, std::string> values_;
};

}  // namespace omnimapper::grid
