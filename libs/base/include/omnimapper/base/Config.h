#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace omnimapper::base {

class Config;

/// One section of an INI file, read into option structs. Every key must belong to one of the tables read from it.
class ConfigSection {
 public:
  const std::string& name() const { return name_; }

  /// The struct with its defaults overwritten by this section. `also_known` are keys that somebody else reads here.
  /// Throws Error unknown_key, wrong_type or out_of_range, naming file and line or --set, section, key, value, bounds
  /// and nearest key.
  template <class Struct>
  Struct read(const std::vector<std::string>& also_known = {}) const {
    const auto& table = Struct::table();
    refuseUnknownKeys(table.specs(), also_known);
    Struct result;
    for (std::size_t i = 0; i < table.specs().size(); ++i) {
      std::string text;
      if (!find(table.specs()[i].key, text)) continue;
      if (const auto bad = table.set(result, i, text)) throwBadValue(table.specs()[i], text, *bad);
    }
    return result;
  }

  /// The raw text of a key, if it is there.
  bool find(const std::string& key, std::string& text) const;

 private:
  friend class Config;
  ConfigSection(const Config& config, std::string name) : config_(&config), name_(std::move(name)) {}
  void refuseUnknownKeys(const std::vector<OptionSpec>& specs, const std::vector<std::string>& also_known) const;
  [[noreturn]] void throwBadValue(const OptionSpec& spec, const std::string& text, const BadValue& bad) const;

  const Config* config_;
  std::string name_;
};

/// First line of an INI that a program of ours wrote by what a log holds.
inline const std::string kWrittenFromALog = "; Written from a log";

/// An INI file with the settings of the command line on top. Sections are handed out by name; what nobody asked for
/// is an error at the end, because a misspelt name is otherwise ignored in silence.
class Config {
 public:
  /// Throws Error(unreadable_input) if the file cannot be read, Error(unknown_key) if a key or section comes twice.
  static Config fromFile(const std::string& path);
  /// Several files, each over those before it: what it sets counts. Without any, an empty one. Throws as fromFile().
  static Config fromFiles(const std::vector<std::string>& paths);
  static Config fromText(const std::string& text, const std::string& name_for_messages);

  /// "section.key=value", as after --set. Throws Error(command_line) if it is not of that form.
  void set(const std::string& assignment);

  bool has(const std::string& section) const;
  /// The section, empty if the file has none of that name: all its options keep their defaults.
  ConfigSection section(const std::string& name) const;
  /// Throws Error(unknown_key) if the file holds a section that section() was never asked for. Two kinds pass: sections
  /// of rawlog-grabber's form (with a "driver" key), which are another program's, and switchedOffPlugins().
  void refuseUnreadSections() const;
  /// Sections of plugins (with a "class" key) that section() was never asked for.
  std::vector<std::string> switchedOffPlugins() const;

  const std::string& file() const { return file_; }
  /// Where a key, or without one a section, was set: "office.ini:12", "--set planes.max_depth_m"; else file().
  std::string placeOf(const std::string& section, const std::string& key = "") const;
  /// Path of the first file; empty if there is none.
  const std::string& firstFile() const { return first_file_; }
  bool isFromCommandLine(const std::string& section, const std::string& key) const;
  /// Whether the user wrote this key himself: it stands in the first file or was set on the command line. Later files
  /// may come from anywhere, as may a first one that begins with kWrittenFromALog. True for what is not set at all.
  bool isTrusted(const std::string& section, const std::string& key) const;
  /// The INI as read, settings of the command line included.
  std::string text() const { return ini_.getContent(); }

 private:
  friend class ConfigSection;
  std::vector<std::string> unreadSections() const;
  void refuseOtherSpelling(const std::string& section, const std::string& key, const std::string& place) const;

  mrpt::config::CConfigFileMemory ini_;
  std::string file_, first_file_;
  bool is_written_from_a_log_ = false;                        // the first file
  using SectionAndKey = std::pair<std::string, std::string>;  // in lower case; no key: the section itself
  std::map<SectionAndKey, std::string> places_;
  std::set<SectionAndKey> from_later_files_;
  mutable std::set<std::string> asked_;
};

/// The candidate nearest to a misspelt name by edit distance; empty if none is near.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace omnimapper::base
