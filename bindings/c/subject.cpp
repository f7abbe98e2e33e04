// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/subject.h"

#include <memory>
#include <utility>

#include "bindings/c/errors.h"

namespace forceshade::c {
constinit Lasting<Subject> subjects;

forceshade_result bad_subject() noexcept {
  return fail(FORCESHADE_BAD_HANDLE, "invalid subject handle: it was never made, or has been freed");
}

forceshade_result add_subject(const Description& description, forceshade_subject* made) {
  auto built = build(description);
  if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
  const std::uint64_t handle = subjects.table.add(std::make_unique<Subject>(std::get<Subject>(std::move(built))));
  if (handle == 0) return fail(FORCESHADE_NO_MEMORY, "there are too many subjects; expected some to be freed");
  made->handle = handle;
  return FORCESHADE_OK;
}

}  // namespace forceshade::c
