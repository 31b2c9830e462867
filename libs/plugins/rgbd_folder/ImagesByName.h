#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "RgbdFolderForms.h"

namespace omnimapper::source {

/// Folders of depth images without a list: depth/ or depths/ with rgb/, color/, colour/, image/ or images/ beside it or
/// none of these, or a folder that has nothing but depth images and texts.
bool hasDepthsByName(const LogLook& look);

/// The depth images of such a folder and the pictures that have their names or, if all names are Unix times, the
/// nearest time. Throws Error(unreadable_input) if there are pictures and none belongs to depths.
RgbdFolderContent readImagesByName(const LogLook& look, const RgbdFolderOptions& options);

/// The folder of `look` that holds depth images, which may be itself; none if it has no such folder.
std::optional<std::filesystem::path> folderOfDepths(const LogLook& look);

}  // namespace omnimapper::source
