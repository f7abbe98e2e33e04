// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject of one of the library's kinds: of a law, a height map, a mesh or a scene.

#include "forceshade/properties.h"

namespace forceshade::properties {

// Only such a subject can be known to have the library's own renderer. A program cannot include this file, so a subject that it
// derives is its own, whatever it forwards to.
class KindOfLibrary : public Subject {
 public:
  // True where no program handed over a renderer.
  bool is_rendered_by_library() const { return is_rendered_by_library_; }

 protected:
  explicit KindOfLibrary(bool is_rendered_by_library) : is_rendered_by_library_(is_rendered_by_library) {}

 private:
  bool is_rendered_by_library_;
};

inline bool is_rendered_by_library(const Subject& subject) {
  const auto* its = dynamic_cast<const KindOfLibrary*>(&subject);
  return its != nullptr && its->is_rendered_by_library();
}

}  // namespace forceshade::properties
