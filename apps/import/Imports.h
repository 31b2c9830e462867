#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/ImageFolder.h>
#include <omnimapper/source/PcdFolder.h>
#include <omnimapper/source/RgbdFolder.h>

#include <string>

/// Throws Error(unreadable_input) if nothing was read, so that no empty rawlog is written, in particular not over
/// an older file.
void refuseNothing(const std::string& input, const omnimapper::source::SourceReport& report);

/// Shows the progress of an import on a terminal.
class ImportProgress {
 public:
  /// From now on the first Ctrl-C does not end the program; the next report() throws instead.
  explicit ImportProgress(const std::string& input);
  /// `share` is in [0, 1]. Throws Error(interrupted) after Ctrl-C, so that no incomplete log is left.
  void report(double share);

 private:
  std::string what_;
  omnimapper::base::TerminalProgress terminal_;
};

/// Writes a rawlog from a folder in which each file is one observation; colour images are stored as JPEG. Prints a
/// summary on standard output.
void importFolder(omnimapper::source::FolderSource& files, const std::string& folder, const std::string& output);

/// Prints on standard output what to do next with the rawlog. `has_only_photographs`: the rawlog contains only
/// photographs.
void sayNext(const std::string& output, bool has_only_photographs);

/// One function for each kind of log that omnimapper-import reads. Each writes a rawlog and prints a summary.

omnimapper::base::ExitCode importCarmen(const std::string& input, const std::string& output,
                                        omnimapper::source::CarmenOdometry odometry);

/// For an `output` X.rawlog, the ground truth is written to X.truth.tum if the folder has one, and with
/// `external_images` the images are written into the folder X_Images. With `poses` the rawlog also has the true poses
/// of the images as CObservationRobotPose.
omnimapper::base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                                      const omnimapper::source::RgbdFolderOptions& options, bool external_images,
                                      bool poses);

omnimapper::base::ExitCode importPcd(const std::string& folder, const std::string& output,
                                     const omnimapper::source::PcdFolderOptions& options);

omnimapper::base::ExitCode importImages(const std::string& folder, const std::string& output,
                                        const omnimapper::source::ImageFolderOptions& options);
