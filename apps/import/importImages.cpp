#include <omnimapper/source/RawlogWriter.h>

#include <iostream>

#include "Imports.h"

using namespace omnimapper;

base::ExitCode importImages(const std::string& folder, const std::string& output,
                            const source::ImageFolderOptions& options) {
  source::ImageFolder images(folder, options);
  ImportProgress progress(folder);
  source::writeRawlog(
      output,
      [&](source::RawlogWriter& rawlog) {
        while (const auto observation = images.next()) {
          rawlog.add(*observation);
          progress.report(images.progress());
        }
        refuseNothing(folder, images.report());
      },
      source::ColourImages::jpeg);
  std::cout << images.report().text()
            << (images.areNamesTimes() ? "stamps: the names of the files\n"
                                       : "stamps: made up by --rate, for the files' names are no Unix times\n")
            << (options.focal_px > 0 ? "" : "camera: made up, a view of 53 deg; --focal-px gives its focal length\n");
  return images.report().exitCode();
}
