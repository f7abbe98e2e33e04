// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/subject.h"

#include <utility>

#include "bindings/c/errors.h"

namespace forceshade::c {
namespace {

template <class Field>
forceshade_result add(std::variant<Field, ParameterError> built, Identity identity, forceshade_subject* made) {
  if (const auto* error = std::get_if<ParameterError>(&built))
    return fail(error->arithmetic_fault == nullptr ? FORCESHADE_BAD_VALUE : FORCESHADE_BAD_ARITHMETIC, error->message());
  const auto& field = std::get<Field>(built);
  const std::uint64_t handle =
      subjects.table.add(std::make_unique<Subject>(Subject{std::move(identity), field, renderer_of(field)}));
  if (handle == 0) return fail(FORCESHADE_NO_MEMORY, "there are too many subjects; expected some to be freed");
  made->handle = handle;
  return FORCESHADE_OK;
}

}  // namespace

constinit Lasting<Subject> subjects;

const Subject* no_subject() noexcept {
  fail(FORCESHADE_BAD_HANDLE, "the subject is none: it was never made, or has been freed");
  return nullptr;
}

forceshade_result add_subject(const Description& description, forceshade_subject* made) {
  if (const auto* law = std::get_if<DescribedLaw>(&description.what))
    return add(fast::Law::build(law->law, law->parameters), identity_of(law->law, law->parameters), made);
  if (const auto* map = std::get_if<DescribedHeightMap>(&description.what))
    return add(fast::HeightMapField::build(map->map, map->mode, map->stiffness),
               identity_of(description.name, map->map, map->mode, map->stiffness), made);
  const auto& mesh = std::get<MeshRendering>(description.what);
  return add(fast::GodObject::build(mesh), identity_of(description.name, mesh), made);
}

}  // namespace forceshade::c
