// SPDX-License-Identifier: BSD-3-Clause
#include "tests/laws/law_suite.h"

#include <array>

#include "fast/simd/batch.h"
#include "forceshade/fast.h"
#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "properties/field_properties.h"
#include "properties/law_subject.h"
#include "properties/positions.h"
#include "tests/laws/cases.h"
#include "tests/laws/force_suite.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade::tests {
namespace {

using properties::same_bits;
using properties::show;

constexpr std::uint64_t kSeed = 20260101;

fast::Law build(LawId law, const Parameters& p) {
  return std::get<fast::Law>(fast::Law::build(law, p));
}

// As the common suite takes it. A batch goes through arrays of x and z, in place where the positions are.
Tested tested(LawId law, const Parameters& p) {
  const fast::Law fast = build(law, p);
  return {std::string(name_of(law)) + ", R = " + show(p.radius) + ", w = " + show(p.width) + ", K = " + show(p.stiffness),
          [fast](const Eigen::Vector3f& position) { return fast.evaluate(position); },
          [reference = std::get<reference::Law>(reference::Law::build(law, p))](const Eigen::Vector3f& position) {
            return reference.round_to_binary32(position);
          },
          [fast](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to, fast::InstructionSet set) {
            std::vector<float> x, z;
            for (const Eigen::Vector3f& position : positions) {
              x.push_back(position.x());
              z.push_back(position.z());
            }
            const fast::BatchResult result = fast.force(x, z, x, z, set);
            for (std::size_t i = 0; i < to.size(); ++i) to[i] = {x[i], 0, z[i]};
            return result;
          }};
}

}  // namespace

const std::vector<Parameters>& parameter_sets() {
  static const std::vector<Parameters> sets{
      {15.24F, 25.4F, 0.5F},
      {20.32F, 25.4F, 0.5F},
      {25.4F, 25.4F, 0.5F},
      {30.48F, 25.4F, 0.5F},
      {35.56F, 25.4F, 0.5F},
      {1.25F, 1.5F, 1.0F},                     // d = 1: rational, ties occur
      {12.7F, 25.4F, 1.0F},                    // w = 2R: d = 0, t = 1/2 a double root
      {12.700001F, 25.4F, 0.75F},              // one unit in the last place short of that
      {1.0F, 1.375F, 0.25F},                   // t = 1/4: w' = R/2
      {1.0F, 1.125F, 0.3F},                    // the cubic splits: t quadratic
      {2197.0F / 1024, 2035.0F / 512, 1.0F},   // t = 5/13: everything rational
      {0x1.2bddap+12F, 0x1.0a96cp+12F, 1.0F},  // t rational with w/2R < 1/2
      {1000.0F, 25.4F, 0.3F},                  // nearly flat
      {1e4F, 1e-3F, 1e3F},                     // domain ends
      {1e4F, 2e4F, 1e-3F},
      {0.1F, 0.2F, 0.001F},
      {0.1F, 1e-3F, 7.3F},
      {3.1415927F, 2.7182817F, 0.57721567F},
  };
  return sets;
}

LawId law_of_file(const char* file) {
  for (const LawName& law : kLaws)
    if (law.file == file) return law.id;
  throw std::invalid_argument(file);
}

void equals_the_rounded_reference(LawId law) {
  const std::size_t points = drawn(40000);
  std::array<std::uint64_t, 3> stages{}, methods{}, statuses{};
  std::array<std::uint64_t, properties::kAims> aims{};
  float closest = 1;
  for (const Parameters& p : parameter_sets()) {
    const fast::Law fast = build(law, p);
    const auto reference = std::get<reference::Law>(reference::Law::build(law, p));
    properties::PositionSource source(reference, kSeed);
    for (std::size_t i = 0; i < points; ++i) {
      const auto [position, aim] = source.next();
      const fast::Evaluation answer = fast.evaluate(position);
      const reference::Rounded exact = reference.round_to_binary32(position);
      const properties::Violation violation = properties::difference(position, {answer.force, answer.status}, exact);
      ASSERT_FALSE(violation) << "R = " << show(p.radius) << ", w = " << show(p.width) << ", K = " << show(p.stiffness) << ": "
                              << *violation;
      ++stages[static_cast<std::size_t>(answer.stage)];
      ++methods[static_cast<std::size_t>(exact.method)];
      ++statuses[static_cast<std::size_t>(exact.status)];
      ++aims[static_cast<std::size_t>(aim)];
      if (exact.ulps_from_tie > 0) closest = std::min(closest, exact.ulps_from_tie);
    }
  }
  std::printf(
      "  stages: binary64 %llu, double-double %llu, wide %llu; reference: filter %llu, enclosure %llu, exact %llu; nearest "
      "to a tie: %.2g units in the last place\n",
      static_cast<unsigned long long>(stages[0]), static_cast<unsigned long long>(stages[1]),
      static_cast<unsigned long long>(stages[2]), static_cast<unsigned long long>(methods[0]),
      static_cast<unsigned long long>(methods[1]), static_cast<unsigned long long>(methods[2]), static_cast<double>(closest));
  for (const std::uint64_t count : statuses) EXPECT_GT(count, 0U) << "a status was never reached";
  for (const std::uint64_t count : aims) EXPECT_GT(count, 0U) << "an aim was never taken";
  // The wall's binary64 product is exact, so it never needs another stage.
  const bool is_product = law == LawId::wall || law == LawId::bump_1p;
  for (std::size_t stage = 0; stage < stages.size(); ++stage)
    EXPECT_EQ(stages[stage] > 0, stage == 0 || !is_product)
        << "stage " << stage << " was reached " << stages[stage] << " times";
}

void answers_its_hard_cases(LawId law) {
  const std::vector<HardCase> cases = hard_cases(law);
  EXPECT_GE(cases.size(), 10U);
  std::array<std::uint64_t, 3> stages{};
  const HardCase* closest = nullptr;
  const auto exponent = [](const HardCase& one) {  // "z 2^-71.3": 71.3; "z 0", a tie: 0
    const std::size_t power = one.from_tie.find("^-");
    return power == std::string::npos ? 0.0 : std::stod(one.from_tie.substr(power + 2));
  };
  for (const HardCase& one : cases) {
    SCOPED_TRACE(one.place + ": " + one.why);
    const auto reference = std::get<reference::Law>(reference::Law::build(law, one.parameters));
    const fast::Law fast = build(law, one.parameters);
    const fast::Evaluation answer = fast.evaluate(one.position);
    const reference::Rounded recorded{one.force, Status::contact};
    const auto expect_recorded = [&](const char* who, const properties::Rendered& rendered) {
      const properties::Violation violation = properties::difference(one.position, rendered, recorded);
      EXPECT_FALSE(violation) << who << ' ' << *violation;
    };
    const reference::Rounded exact = reference.round_to_binary32(one.position);
    expect_recorded("reference", {exact.force, exact.status});
    expect_recorded("fast", {answer.force, answer.status});
    EXPECT_EQ(distance_from_tie(reference, one.position), one.from_tie);
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (!fast::is_available(set)) continue;
      const std::array<std::size_t, 2> ends{0, fast::kBlock - 1};  // the others are easy
      std::vector<float> x(fast::kBlock), z(fast::kBlock, 100), fx(fast::kBlock), fz(fast::kBlock);
      for (const std::size_t i : ends) x[i] = one.position.x(), z[i] = one.position.z();
      fast.force(x, z, fx, fz, set);
      for (const std::size_t i : ends) expect_recorded(fast::name_of(set).data(), {{fx[i], 0, fz[i]}, Status::contact});
    }
    ++stages[static_cast<std::size_t>(answer.stage)];
    if (closest == nullptr || exponent(one) > exponent(*closest)) closest = &one;
  }
  std::printf("  %zu cases; answered by binary64 %llu, double-double %llu, wide %llu; closest: %s, %s of its size from a tie\n",
              cases.size(), static_cast<unsigned long long>(stages[0]), static_cast<unsigned long long>(stages[1]),
              static_cast<unsigned long long>(stages[2]), closest->place.c_str(), closest->from_tie.c_str());
}

void holds_its_properties(LawId law) {
  for (const Parameters& p : parameter_sets()) {
    const auto subject = std::get<properties::RenderedLaw>(properties::fast_rendering(law, p));
    for (const properties::PropertyResult& property :
         properties::run_properties(properties::LawSubject(subject), static_cast<int>(drawn(1000)), kSeed)) {
      EXPECT_TRUE(property.held) << property.name << ", R = " << show(p.radius) << ", w = " << show(p.width)
                                 << ", K = " << show(p.stiffness) << ": " << property.counterexample;
      EXPECT_GE(property.cases, drawn(100));
    }
  }
}

void equals_scalar_at_every_simd_width(LawId law) {
  constexpr std::size_t kCount = 4096 + 37;  // whole blocks and a rest
  int sets = 0;
  for (const fast::InstructionSet set : fast::kInstructionSets) sets += fast::is_available(set);
  std::printf("  %d instruction sets\n", sets);
  for (const Parameters& p : parameter_sets()) {
    const fast::Law fast = build(law, p);
    properties::PositionSource source(std::get<reference::Law>(reference::Law::build(law, p)), kSeed);
    std::vector<float> x(kCount), z(kCount), fx(kCount), fz(kCount);
    std::vector<Eigen::Vector3f> rows(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const Eigen::Vector3f position = source.next().position;
      // Every other half stays clear of what sends a whole block to the scalar call.
      const bool calm = i / 512 % 2 == 0;
      x[i] = calm ? static_cast<float>(i % 512) * 1e-3F * p.width : position.x();
      z[i] = calm ? 1e-4F * p.width * (100 - static_cast<float>(i % 511)) : position.z();  // over the plane and below
      rows[i] = {x[i], calm ? 1e4F : position.y(), z[i]};
    }
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (!fast::is_available(set)) continue;
      std::fill(fx.begin(), fx.end(), 1e30F);  // so that no answer of another set is left to be read
      std::fill(fz.begin(), fz.end(), 1e30F);
      const fast::BatchResult result = fast.force(x, z, fx, fz, set);
      std::size_t invalid = 0;
      for (std::size_t i = 0; i < kCount; ++i) {
        const fast::Evaluation one = fast.evaluate({x[i], 0, z[i]});
        invalid += one.status == Status::invalid;
        ASSERT_TRUE(same_bits(fx[i], one.force.x()) && same_bits(fz[i], one.force.z()))
            << fast::name_of(set) << " at x = " << show(x[i]) << ", z = " << show(z[i]);
      }
      EXPECT_EQ(result.invalid, invalid);
      EXPECT_GT(invalid, 0U);
      // In place of the positions, each output in place of either input.
      for (const bool is_crossed : {false, true}) {
        std::vector<float> a = x, b = z;
        EXPECT_EQ(fast.force(a, b, is_crossed ? b : a, is_crossed ? a : b, set).invalid, invalid);
        EXPECT_TRUE(std::ranges::equal(is_crossed ? b : a, fx, same_bits) &&
                    std::ranges::equal(is_crossed ? a : b, fz, same_bits))
            << fast::name_of(set) << ", in place";
      }
      std::vector<float> a = x, b = z, other(kCount);
      fast.force(a, z, other, a, set);
      fast.force(x, b, b, fz, set);
      EXPECT_TRUE(std::ranges::equal(a, fz, same_bits) && std::ranges::equal(b, fx, same_bits))
          << fast::name_of(set) << ", one output in place";
    }
    Tested by_rows = tested(law, p);
    by_rows.batch = [fast](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to,
                           fast::InstructionSet set) { return fast.force(positions, to, set); };
    expect_scalar_at_every_simd_width(by_rows, rows);
  }
}

void expect_batch_answers(LawId law, const Parameters& p, const Eigen::Vector3f& position, std::size_t place) {
  const fast::Law fast = build(law, p);
  std::vector<float> x(fast::kBlock, 0.3F), z(fast::kBlock, -0.7F);
  x[place] = position.x();
  z[place] = position.z();
  std::vector<Eigen::Vector3f> rows(fast::kBlock, Eigen::Vector3f(0.3F, 0.1F, -0.7F)), forces(fast::kBlock);
  rows[place] = position;
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    std::vector<float> fx(fast::kBlock), fz(fast::kBlock);
    fast.force(x, z, fx, fz, set);
    EXPECT_EQ(fast.force(rows, forces, set).invalid, fast.evaluate(position).status == Status::invalid ? 1U : 0U);
    for (std::size_t i = 0; i < fast::kBlock; ++i) {
      ASSERT_EQ(forces[i], fast.force(rows[i])) << fast::name_of(set) << ", row " << i << " with " << show(position);
      const Eigen::Vector3f one = fast.force({x[i], 0, z[i]});
      ASSERT_TRUE(same_bits(fx[i], one.x()) && same_bits(fz[i], one.z()))
          << fast::name_of(set) << ", " << show(position) << " in place " << place << ", place " << i;
    }
  }
}

void refuses_parameters_outside_the_domain(LawId law) {
  const Parameters good{15.24F, 25.4F, 0.5F};
  const auto expect = [&](const Parameters& p, const char* parameter, const char* message) {
    const auto fast = fast::Law::build(law, p);
    const auto reference = reference::Law::build(law, p);
    ASSERT_TRUE(std::holds_alternative<ParameterError>(fast)) << message;
    ASSERT_TRUE(std::holds_alternative<ParameterError>(reference)) << message;
    EXPECT_STREQ(std::get<ParameterError>(fast).parameter, parameter);
    EXPECT_EQ(std::get<ParameterError>(fast).message(), message);
    EXPECT_EQ(std::get<ParameterError>(reference).message(), message);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect({good.radius, good.width, 9.9e-4F}, "stiffness", "stiffness is 0.00099 N/mm; expected 0.001 to 1000 N/mm");
  expect({good.radius, good.width, 1000.1F}, "stiffness", "stiffness is 1000.1 N/mm; expected 0.001 to 1000 N/mm");
  expect({good.radius, good.width, nan}, "stiffness", "stiffness is nan N/mm; expected 0.001 to 1000 N/mm");
  if (!has_bump_geometry(law)) {
    EXPECT_TRUE(std::holds_alternative<fast::Law>(fast::Law::build(law, {nan, -1, 1}))) << "the wall reads K alone";
    return;
  }
  expect({0.09F, 0.1F, 1}, "radius", "radius is 0.09 mm; expected 0.1 to 10000 mm");
  expect({10001, 1, 1}, "radius", "radius is 10001 mm; expected 0.1 to 10000 mm");
  expect({nan, 1, 1}, "radius", "radius is nan mm; expected 0.1 to 10000 mm");
  expect({1, 9e-4F, 1}, "width", "width is 0.0009 mm; expected 0.001 to 2 mm");
  expect({1, properties::neighbour(2, 1), 1}, "width", "width is 2.0000002 mm; expected 0.001 to 2 mm");
  expect({1, -1, 1}, "width", "width is -1 mm; expected 0.001 to 2 mm");
}

void reports_invalid_positions(LawId law) {
  expect_invalid_positions_reported(tested(law, {15.24F, 25.4F, 0.5F}));
}

void reads_tiny_coordinates_as_zero(LawId law) {
  const std::vector<Eigen::Vector3f> positions{{0, 0, -1}, {3, 0, 0}, {1, 0, 1}, {-12.7F, 4, -2}};
  expect_tiny_coordinates_read_as_zero(tested(law, {15.24F, 25.4F, 0.5F}), positions);
}

void gives_no_negative_zero(LawId law) {
  std::vector<Eigen::Vector3f> positions;
  for (const float x : {-0.0F, 0.0F, -3.0F, 3.0F, 20.0F, -20.0F})
    for (const float z : {-0.0F, 0.0F, -1.0F, 1.0F, 50.0F, -9.0F, -40.0F}) positions.emplace_back(x, -0.0F, z);
  expect_no_negative_zero(tested(law, {15.24F, 25.4F, 0.5F}), positions);
}

void allocates_nothing(LawId law) {
  const Parameters p{1.25F, 1.5F, 1};  // d = 1: ties reach the widest stage
  properties::PositionSource source(std::get<reference::Law>(reference::Law::build(law, p)), kSeed);
  std::vector<Eigen::Vector3f> positions;
  std::vector<float> x(1000), z(1000), fx(1000), fz(1000);
  for (int i = 0; i < 20000; ++i) positions.push_back(source.next().position);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = positions[i].x();
    z[i] = positions[i].z();
  }
  fast::best_instruction_set();
  const std::size_t before = tests::allocations();
  const fast::Law fast = build(law, p);
  float sum = 0;
  for (const Eigen::Vector3f& position : positions) sum += fast.force(position).norm();
  fast.force(x, z, fx, fz);
  EXPECT_EQ(tests::allocations() - before, 0U);
  EXPECT_GT(sum, 0);
}

}  // namespace forceshade::tests
