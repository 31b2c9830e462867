#pragma once

#include <mrpt/config/CConfigFileMemory.h>

#include <map>
#include <string>
#include <vector>

namespace omnimapper::drivers {

/// An INI that remembers which keys were read, because MRPT's drivers ignore keys that they do not know.
class WatchedIni : public mrpt::config::CConfigFileBase {
 public:
  /// `ini` must outlive it.
  explicit WatchedIni(const mrpt::config::CConfigFileMemory& ini) : ini_(ini) {}

  /// Keys of a section that were not read, without those for Windows (COM_port_WIN) or another reader of the section.
  /// If a similar key was read, it is named: "poze_z (did you mean pose_z?)".
  std::vector<std::string> unreadKeys(const std::string& section) const;

  void getAllSections(std::vector<std::string>& sections) const override { ini_.getAllSections(sections); }
  void getAllKeys(const std::string& section, std::vector<std::string>& keys) const override {
    ini_.getAllKeys(section, keys);
  }
  void clear() override {}  // the INI is owned by others and only read

 protected:
  void writeString(const std::string&, const std::string&, const std::string&) override {}
  std::string readString(const std::string& section, const std::string& name, const std::string& default_value,
                         bool fail_if_missing) const override;

 private:
  const mrpt::config::CConfigFileMemory& ini_;
  mutable std::map<std::string, std::string> read_;  // keys as the driver writes them, by lower case; of all sections
};

}  // namespace omnimapper::drivers
