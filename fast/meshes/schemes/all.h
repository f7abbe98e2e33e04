// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one list of the shading schemes of this side.

#include "fast/meshes/schemes/edge_scheme.h"
#include "fast/meshes/schemes/texture_scheme.h"
#include "fast/meshes/schemes/vertex_scheme.h"

namespace forceshade::fast::meshes {

template <class... Scheme>
struct SchemeList {
  static constexpr std::size_t kCount = sizeof...(Scheme);
};
using Schemes = SchemeList<VertexScheme, EdgeScheme, TextureScheme>;
static_assert(Schemes::kCount + 1 == mesh::kShadingNames.size(), "all but `none`");

template <class Numbers, class N, class First, class... Others>
ShadingDirection<N> outward_of(mesh::Shading shading, const Numbers& numbers, const Way3<N>& way, Stage& last,
                               SchemeList<First, Others...>) noexcept {
  if constexpr (sizeof...(Others) > 0)
    if (shading != First::kShading) return outward_of(shading, numbers, way, last, SchemeList<Others...>());
  return First::outward(numbers, way, last);
}

// The direction to which a shading, which is not `none`, turns the force of a rest: one that does not point away from `way`.
// last: raised to the stage of each decision of its own.
template <class Numbers, class N = typename Numbers::N>
ShadingDirection<N> shading_direction(mesh::Shading shading, const Numbers& numbers, const Way3<N>& way, Stage& last) noexcept {
  const ShadingDirection<N> found = outward_of(shading, numbers, way, last, Schemes());
  if (found.outcome != ShadingOutcome::direction) return found;
  const Sign along = proved_sign(dot(found.direction, way.vector));
  if (along == Sign::unknown) return {ShadingOutcome::unknown, {}};
  return along == Sign::positive ? found : ShadingDirection<N>{ShadingOutcome::none, {}};
}

}  // namespace forceshade::fast::meshes
