#include <omnimapper/base/OptionHelp.h>

#include <cctype>
#include <sstream>

namespace omnimapper::base {

namespace {

// '|' separates the columns of a Markdown table.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

}  // namespace

std::string optionsAsMarkdown(const std::vector<OptionSpec>& options) {
  if (options.empty()) return "No options.\n\n";
  std::ostringstream out;
  out << "| key | type | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const auto& option : options) {
    out << "| `" << option.key << "` | " << option.type << " | " << escaped(option.default_value) << " | "
        << escaped(option.range) << " | " << escaped(option.help) << " |\n";
  }
  out << "\n";
  return out.str();
}

std::string optionsAsIni(const std::string& section, const std::string& class_name, const std::string& summary,
                         const std::vector<OptionSpec>& options, const std::set<std::string>& decided) {
  std::ostringstream out;
  out << "; " << summary << "\n[" << section << "]\nclass = " << class_name << "\n";
  for (const auto& option : options) {
    out << "; " << option.help << (option.range.empty() ? "" : " (" + option.range + ")") << "\n"
        << (decided.count(option.key) > 0 ? "; " : "") << option.key << " = " << option.default_value << "\n";
  }
  return out.str();
}

std::string sectionNameFor(const std::string& class_name, const std::vector<std::string>& endings) {
  std::string name;
  for (const char c : class_name) {
    if (std::isupper(static_cast<unsigned char>(c)) && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const std::string& end : endings) {
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
      name.resize(name.size() - end.size());
  }
  return name;
}

}  // namespace omnimapper::base
