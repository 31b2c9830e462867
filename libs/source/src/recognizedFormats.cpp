#include "recognizedFormats.h"

#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/SourceFactory.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace omnimapper::source {

namespace {

// Whether the log begins with the header of one of MRPT's objects: the length of the name of its class, of which the
// first bit is no part, and that name.
bool looksLikeRawlog(const LogLook& look) {
  if (look.head.size() < 2) return false;
  const auto length = static_cast<std::size_t>(static_cast<unsigned char>(look.head[0]) & 0x7F);
  const auto name = std::string_view(look.head).substr(1, length);
  const auto is_of_name = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == ':'; };
  if (name.size() < length || !std::all_of(name.begin(), name.end(), is_of_name)) return false;
  const auto word = name.substr(name.rfind(':') + 1);  // of a name without a colon: all of it
  return name == "nullptr" || (word.size() > 2 && word[0] == 'C' && std::isupper(static_cast<unsigned char>(word[1])));
}

}  // namespace

std::vector<std::string> recognizedFormats(const LogLook& look) {
  std::vector<std::string> formats;
  if (!look.is_folder && looksLikeRawlog(look)) formats.push_back(kRawlog);
  for (const auto& format : registeredFormats())
    if (format->recognizes(look)) formats.push_back(format->name());
  return formats;
}

std::vector<std::string> knownFormats() {
  std::vector<std::string> formats{kRawlog};
  for (const auto& format : registeredFormats()) formats.push_back(format->name());
  return formats;
}

std::string formatsAsText() {
  std::string text = base::option_text::format(knownFormats());
  for (const auto& name : base::namesOfFeatures(base::Registered::format)) {
    if (const auto why = base::whyUnavailable(name); !why.empty()) text += "; " + name + " is not available: " + why;
  }
  return text;
}

}  // namespace omnimapper::source
