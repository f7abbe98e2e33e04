// SPDX-License-Identifier: BSD-3-Clause
#include "properties/field_subject.h"

#include "properties/field_properties.h"
#include "properties/generators.h"
#include "properties/height_properties.h"

namespace forceshade::properties {
namespace {

// Each step depends on its position alone. The field must outlive the session.
template <class Field>
class ReferenceOfField final : public ReferenceSession {
 public:
  explicit ReferenceOfField(const Field& its) : field_(its) {}
  reference::Rounded step(const Eigen::Vector3f& position) override {
    last_ = position;
    return field_.round_to_binary32(position);
  }
  std::optional<std::array<std::string, 3>> decimal(unsigned digits) const override {
    return components(field_.decimal(last_, digits));
  }

 private:
  static std::array<std::string, 3> components(const reference::DecimalForce& force) { return {force.x, "0", force.z}; }
  static std::array<std::string, 3> components(const reference::DecimalMapForce& force) { return {force.x, force.y, force.z}; }

  const Field& field_;
  Eigen::Vector3f last_{0, 0, 0};
};

// The target of the generators of cases.
const reference::Law& target_of(const reference::Law& law, const LawClaims&) {
  return law;
}
HeightTarget target_of(const reference::HeightMapField& map, const HeightMapClaims& claims) {
  return {map, claims};
}

}  // namespace

template <class Field, class Claims>
std::unique_ptr<ReferenceSession> FieldSubject<Field, Claims>::open_reference() const {
  return std::make_unique<ReferenceOfField<Field>>(rendered_.law);
}

template <class Field, class Claims>
std::vector<Eigen::Vector3f> FieldSubject<Field, Claims>::draw_path(Chooser& choose) const {
  // Two, in one session, since a renderer whose first answer is right may remember that position.
  const auto drawn = [&] { return choose(position_of(target_of(rendered_.law, claims_))); };
  const Eigen::Vector3f first = drawn();
  return {first, drawn()};
}

template <class Field, class Claims>
Violation FieldSubject<Field, Claims>::check_unit_normals(Chooser& choose) const {
  return unit_normals(rendered_, choose(position_of(target_of(rendered_.law, claims_))));
}

template <class Field, class Claims>
Violation FieldSubject<Field, Claims>::check_passivity(Chooser& choose) const {
  return passivity(rendered_, claims_, choose(polygon_of(target_of(rendered_.law, claims_))));
}

template class FieldSubject<reference::Law, LawClaims>;
template class FieldSubject<reference::HeightMapField, HeightMapClaims>;

}  // namespace forceshade::properties
