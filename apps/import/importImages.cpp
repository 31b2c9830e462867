#include <iostream>

#include "Imports.h"

using namespace omnimapper;

base::ExitCode importImages(const std::string& folder, const std::string& output,
                            const source::ImageFolderOptions& options) {
  source::ImageFolder images(folder, options);
  importFolder(images, folder, output);
  if (options.focal_px == 0) std::cout << "camera: assumed, with a view of 53 deg; --focal-px sets its focal length\n";
  return images.report().exitCode();
}
