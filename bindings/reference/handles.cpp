// SPDX-License-Identifier: BSD-3-Clause
// Definitions of the C interface of the exact side: from files and texts, and freed; and its last message.

#include "bindings/reference/handles.h"

#include <memory>
#include <string>
#include <utility>

#include "bindings/c/errors.h"
#include "forceshade/fast.h"
#include "forceshade/subjects.h"

namespace forceshade::exact {
namespace {

forceshade_result add(Description description, forceshade_reference* made) {
  auto built = Definition::build(description);
  if (const auto* error = std::get_if<ParameterError>(&built)) return c::fail_with(*error);
  const std::uint64_t handle =
      definitions.table.add(std::make_unique<Defined>(Defined{std::move(description), std::get<Definition>(std::move(built))}));
  if (handle == 0) return c::fail(FORCESHADE_NO_MEMORY, "there are too many definitions; expected some to be freed");
  made->handle = handle;
  return FORCESHADE_OK;
}

void expect_definition(const Defined* found) {
  if (found == nullptr)
    c::require(c::fail(FORCESHADE_BAD_HANDLE, "invalid definition handle: it was never made, or has been freed"));
}

}  // namespace

constinit c::Lasting<Defined> definitions;

const Defined& defined(forceshade_reference handle) {
  const Defined* const found = definitions.table.find(handle.handle);
  expect_definition(found);
  expect_arithmetic();
  return *found;
}

void expect_arithmetic() {
  if (const char* const fault = fast::arithmetic_fault()) c::require(c::fail_with({"arithmetic", "", 0, 0, 0, fault}));
}

}  // namespace forceshade::exact

using namespace forceshade;

const char* forceshade_reference_message(void) {
  return c::last_message();
}

forceshade_result forceshade_reference_read(const char* file, forceshade_reference* made) {
  return c::guarded([&]() -> forceshade_result {
    if (file == nullptr || made == nullptr) return c::fail(FORCESHADE_NULL_POINTER, "file or made is NULL");
    exact::expect_arithmetic();
    return exact::add(subjects::read_file(file), made);
  });
}

forceshade_result forceshade_reference_parse(const char* text, size_t length, const char* file, forceshade_reference* made) {
  return c::guarded([&]() -> forceshade_result {
    if (text == nullptr || file == nullptr || made == nullptr)
      return c::fail(FORCESHADE_NULL_POINTER, "text, file or made is NULL");
    exact::expect_arithmetic();
    return exact::add(subjects::read_text(std::string(text, length), file), made);
  });
}

forceshade_result forceshade_reference_free(forceshade_reference reference) {
  return c::guarded([&]() -> forceshade_result {
    exact::expect_definition(exact::definitions.table.take(reference.handle).get());
    return FORCESHADE_OK;
  });
}
