#pragma once

#include <omnimapper/base/Error.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/source/CarmenLog.h>
#include <omnimapper/source/ImageFolder.h>
#include <omnimapper/source/PcdFolder.h>
#include <omnimapper/source/RgbdFolder.h>

#include <string>

/// Throws Error(unreadable_input) if nothing was read, so that no empty rawlog is left or takes the place of another.
void refuseNothing(const std::string& input, const omnimapper::source::SourceReport& report);

/// How far an import has come, shown on a terminal.
class ImportProgress {
 public:
  /// From now on Ctrl-C is heard by report().
  explicit ImportProgress(const std::string& input);
  /// `share` in [0, 1]. Throws Error(interrupted) after Ctrl-C: half a log is not left for a whole one.
  void report(double share);

 private:
  std::string what_;
  omnimapper::base::TerminalProgress terminal_;
};

/// Writes all of a folder of files, each an observation, and says on standard output what there was; colours as JPEG.
void importFolder(omnimapper::source::FolderSource& files, const std::string& folder, const std::string& output);

/// Says on standard output what to do with a rawlog that was written, which may hold nothing but photographs.
void sayNext(const std::string& output, bool has_photographs);

/// The kinds of logs that omnimapper-import takes: each writes a rawlog and prints a summary.

omnimapper::base::ExitCode importCarmen(const std::string& input, const std::string& output,
                                        omnimapper::source::CarmenOdometry odometry);

/// Leaves the ground truth, if the folder has one, beside the rawlog as <output>.truth.tum, and with `external_images`
/// the images in <output>_Images. With `poses` each image has its true pose beside it in the rawlog, as
/// CObservationRobotPose.
omnimapper::base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                                      const omnimapper::source::RgbdFolderOptions& options, bool external_images,
                                      bool poses);

omnimapper::base::ExitCode importPcd(const std::string& folder, const std::string& output,
                                     const omnimapper::source::PcdFolderOptions& options);

omnimapper::base::ExitCode importImages(const std::string& folder, const std::string& output,
                                        const omnimapper::source::ImageFolderOptions& options);
