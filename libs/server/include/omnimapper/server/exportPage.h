#pragma once

#include <string>

namespace omnimapper::server {

/// Writes the page of a map as a folder that a browser opens without a server of ours: index.html, the style, page.js
/// (all scripts of `page_folder` in one, because browsers load no modules from files), map.js (what the page shows, as
/// it was at that time) and the pictures of objects, in place of those of an earlier copy. `map` is the folder of a
/// map, or a map file. Throws Error(unreadable_input) if the map cannot be read, `page_folder` has no page, or a script
/// is not of the form that bundled() takes; Error(command_line) if `output` is the folder of the map or `page_folder`;
/// Error(unwritable_output) or Error(disk_full).
void exportPage(const std::string& map, const std::string& page_folder, const std::string& output);

}  // namespace omnimapper::server
