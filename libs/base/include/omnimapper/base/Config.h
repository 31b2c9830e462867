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

/// One section of an INI file, read into structs of options.
class ConfigSection {
 public:
  const std::string& name() const { return name_; }

  /// The struct with its defaults overwritten by this section. Every key of the section must be in the table of the
  /// struct or in `also_known`, the keys that other code reads. Throws Error unknown_key, wrong_type or out_of_range;
  /// the message names the place (file and line, or --set), the section and the key, and the bounds of the value or the
  /// most similar key.
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

  /// Gets the raw text of a key. Returns false if the section does not have it.
  bool find(const std::string& key, std::string& text) const;

 private:
  friend class Config;
  ConfigSection(const Config& config, std::string name) : config_(&config), name_(std::move(name)) {}
  void refuseUnknownKeys(const std::vector<OptionSpec>& specs, const std::vector<std::string>& also_known) const;
  [[noreturn]] void throwBadValue(const OptionSpec& spec, const std::string& text, const BadValue& bad) const;

  const Config* config_;
  std::string name_;
};

/// Beginning of an INI that a program of this project generated from a log.
inline const std::string kWrittenFromALog = "; Written from a log";

/// An INI file, some of whose keys may be overridden by settings of the command line. Sections are read by name. A
/// section that was never read is an error (refuseUnreadSections()), because a misspelt name would otherwise be ignored
/// silently.
class Config {
 public:
  /// Throws Error(unreadable_input) if the file cannot be read, and Error(unknown_key) if a key or section occurs
  /// twice.
  static Config fromFile(const std::string& path);
  /// Reads several files, of which each overrides those before it. If there are no files, the result is empty. Throws
  /// as fromFile() does.
  static Config fromFiles(const std::vector<std::string>& paths);
  static Config fromText(const std::string& text, const std::string& name_for_messages);

  /// Sets a key, given as "section.key=value" as with --set. Throws Error(command_line) if `assignment` does not have
  /// that form.
  void set(const std::string& assignment);

  bool has(const std::string& section) const;
  /// The section with that name. If the file does not have it, the section is empty and all its options keep their
  /// defaults.
  ConfigSection section(const std::string& name) const;
  /// Throws Error(unknown_key) if the file has a section for which section() was never called. Allowed are only
  /// switchedOffPlugins() and sections with a key "driver", which may be for MRPT's rawlog-grabber.
  void refuseUnreadSections() const;
  /// The same for an INI that replaces `before` during a run: sections that were read from `before`, or that it has,
  /// are allowed.
  void refuseUnreadSections(const Config& before) const;
  /// Sections of plugins (those with a key "class") for which section() was never called.
  std::vector<std::string> switchedOffPlugins() const;

  const std::string& file() const { return file_; }
  /// The place where a key was set, such as "office.ini:12" or "--set planes.max_depth_m"; with an empty `key`, the
  /// place of the section. If it was not set: file().
  std::string placeOf(const std::string& section, const std::string& key = "") const;
  /// Path of the first file; empty if there is none.
  const std::string& firstFile() const { return first_file_; }
  bool isFromCommandLine(const std::string& section, const std::string& key) const;
  /// Whether the user set this key deliberately, that is, in the first file or on the command line. Later files may
  /// come from anywhere, and so may a first file that begins with kWrittenFromALog. Also true for a key that is not set
  /// at all.
  bool isTrusted(const std::string& section, const std::string& key) const;
  /// The INI text as it is used, including the settings of the command line.
  std::string text() const { return ini_.getContent(); }

 private:
  friend class ConfigSection;
  std::vector<std::string> unreadSections() const;
  void refuseOtherSpelling(const std::string& section, const std::string& key, const std::string& place) const;

  mrpt::config::CConfigFileMemory ini_;
  std::string file_, first_file_;
  bool is_written_from_a_log_ = false;                        // the first file begins with kWrittenFromALog
  using SectionAndKey = std::pair<std::string, std::string>;  // in lower case; an empty key means the section itself
  std::map<SectionAndKey, std::string> places_;
  std::set<SectionAndKey> from_later_files_;
  mutable std::set<std::string> asked_;
};

/// The candidate nearest to a misspelt name by edit distance; empty if none is close.
std::string nearestName(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace omnimapper::base
