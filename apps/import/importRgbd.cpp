#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Progress.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/source/ExternalImages.h>
#include <omnimapper/source/RawlogWriter.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "Imports.h"

using namespace omnimapper;

base::ExitCode importRgbd(const std::string& folder, const std::string& output,
                          const source::RgbdFolderOptions& options, bool external_images) {
  source::RgbdFolder images(folder, options);
  const std::string stem = std::filesystem::path(output).replace_extension().string(), truth = stem + ".truth.tum";
  base::TerminalProgress progress(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto fill = [&](source::RawlogWriter& rawlog) {
    while (const auto observation = images.next()) {
      if (external_images) {
        base::makeWritableFolder(stem + "_Images");
        source::moveImagesToFiles(*observation, stem + "_Images",
                                  options.label + "_" + base::formatUnix(observation->timestamp, 6));
      }
      rawlog.add(*observation);
      progress.report(images.progress(), "importing " + folder);
    }
    refuseNothing(folder, images.report());
  };
  source::writeRawlog(output, fill, source::ColourImages::jpeg);
  if (!images.groundTruth().empty()) {
    base::writeFile(truth, [&](std::ostream& out) {
      for (const auto& [stamp, world_from_base] : images.groundTruth())
        out << geometry::tumLine(stamp, world_from_base);
    });
  }
  std::cout << images.report().text() << "depth images without a colour image of their time: " << images.unpaired()
            << "\n";
  if (!images.groundTruth().empty())
    std::cout << "ground truth of the base (x forward, z up): " << truth << ", " << images.groundTruth().size()
              << " poses\n";
  return images.report().exitCode();
}
