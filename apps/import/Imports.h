#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/ImageFolder.h>
#include <omnimapper/source/PcdFolder.h>
#include <omnimapper/source/RgbdFolder.h>

#include <string>

/// Throws Error(unreadable_input) if nothing was read, so that no empty rawlog is left or replaces another.
void refuseNothing(const std::string& input, const omnimapper::source::SourceReport& report);

/// Shows the progress of an import on a terminal.
class ImportProgress {
 public:
  /// From now on report() handles Ctrl-C.
  explicit ImportProgress(const std::string& input);
  /// `share` is in [0, 1]. Throws Error(interrupted) after Ctrl-C, so that no incomplete log is left.
  void report(double share);

 private:
  std::string what_;
  omnimapper::base::TerminalProgress terminal_;
};

/// Writes a folder of files, one observation each, to a rawlog with colour images as JPEG, and prints a summary on
/// standard output.
void importFolder(omnimapper::source::FolderSource& files, const std::string& folder, const std::string& output);

/// Prints on standard output what to do next with the rawlog; `has_photographs` is set if it contains only photographs.
void sayNext(const std::string& output, bool has_photographs);

/// The kinds of logs that omnimapper-import reads: each function writes a rawlog and prints a summary.

omnimapper::base::ExitCode importCarmen(const std::string& input, const std::string& output,
                                        omnimapper::source::CarmenOdometry odometry);

/// Writes the ground truth, if the folder has one, beside the rawlog as <output>.truth.tum, and with `external_images`
/// the images into <output>_Images. With `poses` the rawlog also has the true pose of each image as
/// CObservationRobotPose.
omnimapper::base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                                      const omnimapper::source::RgbdFolderOptions& options, bool external_images,
                                      bool poses);

omnimapper::base::ExitCode importPcd(const std::string& folder, const std::string& output,
                                     const omnimapper::source::PcdFolderOptions& options);

omnimapper::base::ExitCode importImages(const std::string& folder, const std::string& output,
                                        const omnimapper::source::ImageFolderOptions& options);
