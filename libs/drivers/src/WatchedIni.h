#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <set>
#include <string>
#include <vector>

namespace omnimapper::drivers {

/// An INI that remembers which keys were read: MRPT's drivers take no notice of keys that they do not know.
class WatchedIni : public mrpt::config::CConfigFileBase {
 public:
  /// `ini` must outlive it.
  explicit WatchedIni(const mrpt::config::CConfigFileMemory& ini) : ini_(ini) {}

  /// Keys of a section that were not read, those left out that are for another system (COM_port_WIN) or another reader
  /// of the section; each with the nearest key that was read, "poze_z (did you mean pose_z?)".
  std::vector<std::string> unreadKeys(const std::string& section) const;

  void getAllSections(std::vector<std::string>& sections) const override { ini_.getAllSections(sections); }
  void getAllKeys(const std::string& section, std::vector<std::string>& keys) const override {
    ini_.getAllKeys(section, keys);
  }
  void clear() override {}  // an INI of others, which is only read

 protected:
  void writeString(const std::string&, const std::string&, const std::string&) override {}
  std::string readString(const std::string& section, const std::string& name, const std::string& default_value,
                         bool fail_if_missing) const override;

 private:
  const mrpt::config::CConfigFileMemory& ini_;
  mutable std::set<std::string> read_;  // in lower case, as MRPT compares them, of all sections
};

}  // namespace omnimapper::drivers
