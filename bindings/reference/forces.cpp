// SPDX-License-Identifier: BSD-3-Clause
// Exact forces of the C interface: in digits, compared, rounded, and beside those that the caller has.

#include <bit>
#include <cstdint>
#include <optional>
#include <string>

#include "bindings/c/batch.h"
#include "bindings/c/errors.h"
#include "bindings/c/strided.h"
#include "bindings/reference/handles.h"
#include "bindings/reference/rational.h"
#include "text/beginning.h"

namespace forceshade::exact {
namespace {

forceshade_result null(const char* words) noexcept {
  return c::fail(FORCESHADE_NULL_POINTER, words);
}

// The definition, whose force has to depend on the position alone.
const Definition& of_a_position(forceshade_reference handle) {
  const Definition& its = defined(handle).definition;
  if (its.depends_on_the_path())
    c::require(
        c::fail(FORCESHADE_WRONG_KIND,
                "the force of a mesh depends on the path; expected forceshade_reference_forces() of a path's positions"));
  return its;
}

// The definition beside a batch that has to be in order.
const Definition& of_a_batch(forceshade_reference handle, const forceshade_batch* batch) {
  const Definition& its = defined(handle).definition;
  c::require(c::check(batch));
  return its;
}

void expect_digits(std::uint32_t digits) {
  if (digits < 1 || digits > kMostDigits)
    c::require(c::fail(FORCESHADE_BAD_VALUE,
                       "digits is " + std::to_string(digits) + "; expected 1 to " + std::to_string(kMostDigits)));
}

// True if the caller's answer with this index is the exact one.
bool is_same(const forceshade_batch& batch, std::size_t index, const Answer& exact) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float given = *c::at(batch.forces, index, batch.force_stride, axis, batch.force_component);
    if (std::bit_cast<std::uint32_t>(given) != std::bit_cast<std::uint32_t>(exact.force[static_cast<Eigen::Index>(axis)]))
      return false;
  }
  return batch.statuses == nullptr || *c::at(batch.statuses, index, batch.status_stride) == exact.status;
}

}  // namespace
}  // namespace forceshade::exact

using namespace forceshade;
using namespace forceshade::exact;

forceshade_result forceshade_reference_decimals(forceshade_reference reference, const float* position, uint32_t digits,
                                                char* text, size_t size, size_t* length, forceshade_status* status) {
  return c::guarded([&]() -> forceshade_result {
    const Definition& its = of_a_position(reference);
    if (position == nullptr) return null("position is NULL");
    c::require(c::check_room(text, size));
    expect_digits(digits);
    const Decimals force = its.decimals(*c::as_vectors(position), digits);
    c::give(force.force[0] + ' ' + force.force[1] + ' ' + force.force[2], text, size, length);
    if (status != nullptr) *status = force.status;
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_reference_compare(forceshade_reference reference, const float* position, uint32_t axis,
                                               const char* rational, int32_t* sign) {
  return c::guarded([&]() -> forceshade_result {
    const Definition& its = of_a_position(reference);
    if (position == nullptr || rational == nullptr || sign == nullptr) return null("position, rational or sign is NULL");
    if (axis > 2) return c::fail(FORCESHADE_BAD_VALUE, "axis is " + std::to_string(axis) + "; expected 0 to 2 for x, y and z");
    const std::optional<std::string> number = rational_of(rational);
    if (!number)
      return c::fail(FORCESHADE_BAD_VALUE, "rational: expected a number such as -3/4, -0.75 or 7.5e-1, got \"" +
                                               std::string(beginning_of(rational, 64)) + '"');
    *sign = its.compare(*c::as_vectors(position), axis, *number);
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_reference_forces(forceshade_reference reference, const forceshade_batch* batch, size_t* invalid) {
  return c::guarded([&]() -> forceshade_result {
    const Definition& its = of_a_batch(reference, batch);
    const std::size_t found = fill(*batch, its.along_a_path());
    if (invalid != nullptr) *invalid = found;
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_reference_differences(forceshade_reference reference, const forceshade_batch* batch, size_t* first,
                                                   size_t* count) {
  return c::guarded([&]() -> forceshade_result {
    const Definition& its = of_a_batch(reference, batch);
    if (count == nullptr) return null("count is NULL");
    const auto answer = its.along_a_path();
    std::size_t differ = 0, earliest = batch->count;
    for (std::size_t i = 0; i < batch->count; ++i) {
      if (is_same(*batch, i, answer(position_of(*batch, i)))) continue;
      if (differ++ == 0) earliest = i;
    }
    *count = differ;
    if (first != nullptr) *first = earliest;
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_reference_geometry(float radius, float width, uint32_t digits, char* text, size_t size,
                                                size_t* length) {
  return c::guarded([&]() -> forceshade_result {
    expect_arithmetic();
    c::require(c::check_room(text, size));
    expect_digits(digits);
    const auto built = geometry(radius, width, digits);
    if (const auto* error = std::get_if<ParameterError>(&built)) return c::fail_with(*error);
    const auto& its = std::get<reference::DecimalGeometry>(built);
    c::give(its.d + '\n' + its.h + '\n' + its.w_prime + '\n' + its.h_prime + '\n' + its.theta, text, size, length);
    return FORCESHADE_OK;
  });
}
