// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that laws and height maps share as subjects: the force depends on the position alone.

#include <utility>

#include "forceshade/properties.h"
#include "properties/height_map_claims.h"
#include "properties/kind_of_library.h"
#include "properties/law_claims.h"
#include "properties/rendered.h"

namespace forceshade::properties {

// Field: reference::Law or reference::HeightMapField. Claims: what is expected of it.
template <class Field, class Claims>
class FieldSubject : public KindOfLibrary {
 public:
  const Rendering& rendering() const override { return rendering_; }
  std::unique_ptr<ReferenceSession> open_reference() const override;
  std::vector<Eigen::Vector3f> draw_path(Chooser& choose) const override;
  Violation check_unit_normals(Chooser& choose) const override;
  Violation check_passivity(Chooser& choose) const override;

 protected:
  FieldSubject(Rendering rendering, Field field, bool is_rendered_by_library)
      : KindOfLibrary(is_rendered_by_library),
        rendering_(std::move(rendering)),
        rendered_{std::move(field), force_at_of(rendering_.renderer)},
        claims_(rendered_.law) {}

  Rendering rendering_;
  RenderedField<Field> rendered_;
  Claims claims_;
};

extern template class FieldSubject<reference::Law, LawClaims>;
extern template class FieldSubject<reference::HeightMapField, HeightMapClaims>;

}  // namespace forceshade::properties
