// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tests that every law passes, under the law's own name: FORCESHADE_LAW_SUITE(bump_2p) in tests/laws/bump_2p_test.cpp.

#include <gtest/gtest.h>

#include "properties/rendered.h"

namespace forceshade::tests {

// The five bumps of the thesis, and parameters at which geometry degenerates or every number is rational.
const std::vector<Parameters>& parameter_sets();

LawId law_of_file(const char* file);

void equals_the_rounded_reference(LawId law);
void answers_its_hard_cases(LawId law);
void holds_its_properties(LawId law);
void equals_scalar_at_every_simd_width(LawId law);
void refuses_parameters_outside_the_domain(LawId law);
void reports_invalid_positions(LawId law);
void reads_tiny_coordinates_as_zero(LawId law);
void gives_no_negative_zero(LawId law);
void allocates_nothing(LawId law);

// The position, alone in its place of a block that packs would answer without it, gets the bits of the scalar call.
void expect_batch_answers(LawId law, const Parameters& p, const Eigen::Vector3f& position, std::size_t place);

}  // namespace forceshade::tests

#define FORCESHADE_LAW_CLAIM(law, claim)                            \
  TEST(law, claim) {                                                \
    forceshade::tests::claim(forceshade::tests::law_of_file(#law)); \
  }

#define FORCESHADE_LAW_SUITE(law)                                  \
  FORCESHADE_LAW_CLAIM(law, equals_the_rounded_reference)          \
  FORCESHADE_LAW_CLAIM(law, answers_its_hard_cases)                \
  FORCESHADE_LAW_CLAIM(law, holds_its_properties)                  \
  FORCESHADE_LAW_CLAIM(law, equals_scalar_at_every_simd_width)     \
  FORCESHADE_LAW_CLAIM(law, refuses_parameters_outside_the_domain) \
  FORCESHADE_LAW_CLAIM(law, reports_invalid_positions)             \
  FORCESHADE_LAW_CLAIM(law, reads_tiny_coordinates_as_zero)        \
  FORCESHADE_LAW_CLAIM(law, gives_no_negative_zero)                \
  FORCESHADE_LAW_CLAIM(law, allocates_nothing)
