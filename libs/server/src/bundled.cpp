#include "bundled.h"

#include <omnimapper/base/Error.h>

#include <regex>
#include <set>
#include <sstream>

namespace omnimapper::server {

namespace {

class Bundle {
 public:
  explicit Bundle(const std::map<std::string, std::string>& modules) : modules_(modules) {}

  void add(const std::string& name) {
    if (added_.count(name) > 0) return;
    const auto module = modules_.find(name);
    if (module == modules_.end() || !begun_.insert(name).second)
      throw base::Error(base::ExitCode::unreadable_input,
                        name + ": this script of the page is missing or imports itself; install OmniMapper again");
    std::string body, exported;
    std::istringstream lines(module->second);
    for (std::string line; std::getline(lines, line);) body += translated(line, exported) + "\n";
    script_ += "modules['" + name + "'] = (() => {\n" + body + "return {" + exported + " };\n})();\n";
    added_.insert(name);
  }
  std::string script() const { return "'use strict';\n(() => {\nconst modules = {};\n" + script_ + "})();\n"; }

 private:
  std::string translated(const std::string& line, std::string& exported) {
    static const std::regex import(R"(^import (?:\* as )?(.*) from '\./([\w.]+)';$)");
    static const std::regex exporting(R"(^export ((?:async )?function|class|const) (?:\[(.*?)\]|(\w+)))");
    std::smatch found;
    if (std::regex_match(line, found, import)) {
      add(found[2]);
      return "const " + found[1].str() + " = modules['" + found[2].str() + "'];";
    }
    if (!std::regex_search(line, found, exporting)) return line;
    exported += (exported.empty() ? " " : ", ") + (found[2].matched ? found[2].str() : found[3].str());
    return line.substr(std::string("export ").size());
  }

  const std::map<std::string, std::string>& modules_;
  std::set<std::string> begun_, added_;
  std::string script_;
};

}  // namespace

std::string bundled(const std::map<std::string, std::string>& modules, const std::string& first) {
  Bundle bundle(modules);
  bundle.add(first);
  return bundle.script();
}

}  // namespace omnimapper::server
