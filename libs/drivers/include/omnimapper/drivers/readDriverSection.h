#pragma once

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/core/exceptions.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OptionTable.h>

#include <string>
#include <vector>

namespace omnimapper::drivers {

/// Throws Error(unknown_key) if the section holds a key that is neither in `specs` nor one that every section of a
/// driver may have.
void refuseUnknownKeys(const mrpt::config::CConfigFileBase& ini, const std::string& section,
                       const std::vector<base::OptionSpec>& specs);

/// Reads the options of a driver from its section of an INI, which MRPT passes to loadConfig(). Throws Error
/// unknown_key, wrong_type or out_of_range, naming section, key, value and the valid values.
template <class Struct>
Struct readDriverSection(const mrpt::config::CConfigFileBase& ini, const std::string& section) {
  const auto& table = Struct::table();
  refuseUnknownKeys(ini, section, table.specs());
  Struct result;
  for (std::size_t i = 0; i < table.specs().size(); ++i) {
    const auto& key = table.specs()[i].key;
    if (!ini.keyExists(section, key)) continue;
    const std::string text = ini.read_string(section, key, "");
    const auto bad = table.set(result, i, text);
    if (!bad) continue;
    const bool wrong_type = bad->kind == base::BadValue::Kind::type;
    throw base::Error(wrong_type ? base::ExitCode::wrong_type : base::ExitCode::out_of_range,
                      "[" + section + "] " + key + " = " + text + ": it takes " + bad->expected);
  }
  return result;
}

/// Returns what read() returns, for the body of a loadConfig_sensorSpecific(). It wraps a base::Error in MRPT's kind of
/// exception, because MRPT's loadConfig() converts every other one to a plain std::exception without the exit code.
template <class Read>
auto readUnderMrpt(const Read& read) {
  try {
    return read();
  } catch (const base::Error& error) {
    throw mrpt::ExceptionWithCallBack<base::Error>(error);
  }
}

}  // namespace omnimapper::drivers
