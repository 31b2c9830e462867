#include <omnimapper/base/Numbers.h>

#include <iostream>

#include "Imports.h"

using namespace omnimapper;

base::ExitCode importPcd(const std::string& folder, const std::string& output,
                         const source::PcdFolderOptions& options) {
  source::PcdFolder clouds(folder, options);
  importFolder(clouds, folder, output);
  if (clouds.unorganized() > 0) {
    std::cout << base::counted(clouds.unorganized(), "cloud")
              << " without rows and columns (HEIGHT 1): they remain clouds, which can only be mapped together with "
                 "odometry or poses\n";
  }
  return clouds.report().exitCode();
}
