#include <omnimapper/base/Numbers.h>
#include <omnimapper/source/RawlogWriter.h>

#include <iostream>

#include "Imports.h"

using namespace omnimapper;

base::ExitCode importPcd(const std::string& folder, const std::string& output,
                         const source::PcdFolderOptions& options) {
  source::PcdFolder clouds(folder, options);
  ImportProgress progress(folder);
  source::writeRawlog(
      output,
      [&](source::RawlogWriter& rawlog) {
        while (const auto observation = clouds.next()) {
          rawlog.add(*observation);
          progress.report(clouds.progress());
        }
        refuseNothing(folder, clouds.report());
      },
      source::ColourImages::jpeg);
  std::cout << clouds.report().text()
            << (clouds.areNamesTimes() ? "stamps: the names of the files\n"
                                       : "stamps: made up by --rate, for the files' names are no Unix times\n");
  if (clouds.unorganised() > 0) {
    std::cout << base::counted(clouds.unorganised(), "cloud")
              << " without rows and columns (HEIGHT 1): they stay clouds, which are mapped only with odometry or poses "
                 "beside them\n";
  }
  return clouds.report().exitCode();
}
