#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/source/LogSource.h>
#include <omnimapper/source/SourceOptions.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::source {

/// Opens one log, or several merged by stamp, with start_s and end_s counted from the earliest first stamp of all. A
/// log is a rawlog or of a registered format (SourceFactory), and is recognized by what it looks like. Every log is
/// first read by a child process, so that data that make a reader crash end the log and not the program; the children
/// are started before the first log is opened in this process. Every log also has its observations checked by an
/// ObservationGate of its own.
/// Throws Error(command_line) if there is no path; Error(unreadable_input) if a log cannot be opened, or no format
/// recognizes it; Error(command_line) if several do; and Error(interrupted) if `stop` returns true.
std::unique_ptr<ObservationSource> openLogs(const std::vector<std::string>& paths, const SourceOptions& options,
                                            const StopOpening& stop = {});

/// Opens one log as the registered format of that name, whatever it looks like. Throws as openLogs(), and
/// Error(unknown_plugin) if no such format is registered.
std::unique_ptr<ObservationSource> openLogAs(const std::string& format, const std::string& path,
                                             const SourceOptions& options, const StopOpening& stop = {});

/// [source] of an INI and the sections of all registered formats, without the offsets of clocks. Throws as
/// base::ConfigSection::read(), and Error(unknown_plugin) if [source] formats names a format that is not known.
SourceOptions readSourceOptions(const base::Config& config);

}  // namespace omnimapper::source
