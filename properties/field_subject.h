// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What laws and height maps have in common as subjects: the force depends on the position alone.

#include <utility>

#include "properties/height_map_claims.h"
#include "properties/law_claims.h"
#include "properties/subject.h"

namespace forceshade::properties {

// Field: reference::Law or reference::HeightMapField. Claims: what is expected of it.
template <class Field, class Claims>
class FieldSubject : public Subject {
 public:
  const Identity& identity() const override { return identity_; }
  std::unique_ptr<ReferenceSession> open_reference() const override;
  const Calls& calls() const override { return calls_; }
  std::vector<Eigen::Vector3f> draw_path() const override;
  Violation check_unit_normals() const override;
  Violation check_passivity() const override;
  std::vector<std::string> jumps() const override { return claims_.jumps(); }

 protected:
  FieldSubject(Calls calls, Field field, Identity identity)
      : calls_(std::move(calls)),
        rendered_{std::move(field), renderer_of(calls_)},
        claims_(rendered_.law),
        identity_(std::move(identity)) {}
  FieldSubject(RenderedField<Field> rendered, Identity identity)
      : FieldSubject(calls_of(rendered.renderer), std::move(rendered.law), std::move(identity)) {}

  Calls calls_;
  RenderedField<Field> rendered_;
  Claims claims_;
  Identity identity_;
};

extern template class FieldSubject<reference::Law, LawClaims>;
extern template class FieldSubject<reference::HeightMapField, HeightMapClaims>;

}  // namespace forceshade::properties
