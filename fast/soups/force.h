// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The force of a god-object at rest on any set of triangles (docs/soups.md).

#include <array>

#include "fast/soups/way.h"

namespace forceshade::fast::soups {

// K D; with the soup's corner normals K (|D_n| N/|N| + D_t): each component the binary32 nearest to it. q: where friction holds
// a part, p's foot; otherwise null. stiffness: N/mm, of triangles without one of their own.
std::array<float, 3> force_at(const Soup& soup, const At& r, const Point& p, const Point* q, float stiffness, bool is_shaded);

// Each the largest of the triangles that hold r.
damping::Limits damping_at(const Soup& soup, const At& r);

}  // namespace forceshade::fast::soups
