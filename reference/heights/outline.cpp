// SPDX-License-Identifier: BSD-3-Clause
#include "reference/heights/outline.h"

#include "reference/heights/all.h"

namespace forceshade::reference {

Outline outline(const height::Part& part) {
  return std::visit([](const auto& shape) { return outline_of(as_shape(shape)); }, part.shape);
}

}  // namespace forceshade::reference
