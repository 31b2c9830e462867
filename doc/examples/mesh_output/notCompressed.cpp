#include "compressed.h"

namespace mesh_output {

Compressed compressed(const std::string& text) {
  return {text, ""};
}

}  // namespace mesh_output
