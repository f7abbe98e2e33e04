// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certificate/certify.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "forceshade/certificate/build.h"
#include "forceshade/certificate/compare.h"
#include "forceshade/certificate/evidence.h"
#include "forceshade/certificate/height_loops.h"
#include "forceshade/certificate/in_parallel.h"
#include "forceshade/certificate/plain_text.h"
#include "forceshade/certificate/spread.h"
#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/law.h"
#include "forceshade/properties/height_positions.h"
#include "forceshade/properties/passivity.h"
#include "forceshade/properties/positions.h"
#include "forceshade/properties/run.h"
#include "forceshade/reference/energy.h"

namespace forceshade::properties {
namespace {

constexpr std::uint64_t kChunk = 4096;           // points from one stream
constexpr std::uint64_t kPointsOfASet = 1024;    // of a law, with one set of drawn parameters
constexpr std::uint64_t kStiffnessesOfAMap = 8;  // drawn ones: the two sides of a map take long to build

using Done = std::function<void(double)>;

// What one certificate's checks have in common.
struct Run {
  const CertifyOptions& options;
  const std::atomic<bool>& stop;

  // Streams are told apart by the golden ratio's odd multiple: no two chunks or seeds in reach share one.
  std::uint64_t stream(std::uint64_t chunk) const { return (options.seed + 1) * 0x9E3779B97F4A7C15U + chunk; }
  // Of the spread: as far from those as can be.
  std::uint64_t spread_stream(std::uint64_t chunk) const { return stream(chunk) ^ 0x8000000000000000U; }

  Tally in_parallel(std::uint64_t chunks, const Done& done, const std::function<void(std::uint64_t, Tally&)>& work) const {
    return properties::in_parallel(chunks, options.threads, done, stop, work);
  }

  OnCase on_case(std::string_view subject) const {
    if (!options.on_case) return {};
    return [this, subject](const std::string& property, double done) { options.on_case(subject, property, done); };
  }

  // source(seed): a stream of positions on what the reference is.
  template <class Reference, class MakeSource>
  Findings at_points(const Calls& calls, const Reference& reference, const MakeSource& source, const Done& done) const {
    const std::uint64_t chunks = (options.points + kChunk - 1) / kChunk;
    const Tally tally = in_parallel(chunks, done, [&](std::uint64_t chunk, Tally& mine) {
      compare_chunk(calls, reference, source(stream(chunk)), std::min(kChunk, options.points - chunk * kChunk), chunk, "",
                    mine);
    });
    Findings found{tally.comparison()};
    found.closest_call = tally.closest_call;
    return found;
  }

  // compare(set, count, tally): `count` points with one set of drawn parameters, `size` at most.
  template <class Compare>
  Spread spread(std::uint64_t size, const Done& done, const Compare& compare) const {
    const std::uint64_t points = spread_points(options.points), sets = (points + size - 1) / size;
    const Tally tally = in_parallel(
        sets, done, [&](std::uint64_t set, Tally& mine) { compare(set, std::min(size, points - set * size), mine); });
    return {tally.comparison(), sets};
  }
};

// Progress of the points asked for and of the spread, by their numbers.
Done first_part(const Done& done) {
  return [&done](double part) { done(0.8 * part); };
}
Done second_part(const Done& done) {
  return [&done](double part) { done(0.8 + 0.2 * part); };
}

Spread spread_of(LawId id, const Run& run, const Done& done) {
  return run.spread(kPointsOfASet, done, [&](std::uint64_t set, std::uint64_t count, Tally& tally) {
    const std::uint64_t seed = run.spread_stream(set);
    const Parameters p = ParameterSource(seed).next();
    const auto reference = std::get<reference::Law>(reference::Law::build(id, p));
    const std::string bump =
        has_bump_geometry(id) ? "R = " + show(p.radius) + " mm, w = " + show(p.width) + " mm, " : std::string();
    compare_chunk(run.options.calls.law(id, p), reference, PositionSource(reference, seed), count, set,
                  bump + "K = " + show(p.stiffness) + " N/mm: ", tally);
  });
}

Spread spread_of(const NamedHeightMap& named, const HeightShape& shape, const Run& run, const Done& done) {
  const auto& [file, map, rendering] = named;
  const std::uint64_t points = spread_points(run.options.points);
  return run.spread(
      (points + kStiffnessesOfAMap - 1) / kStiffnessesOfAMap, done, [&](std::uint64_t set, std::uint64_t count, Tally& tally) {
        const std::uint64_t seed = run.spread_stream(set);
        const float stiffness = ParameterSource(seed).next().stiffness;
        const auto reference = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, rendering, stiffness));
        compare_chunk(run.options.calls.height_map(map, rendering, stiffness), reference,
                      HeightPositionSource(reference, shape, seed), count, set, "K = " + show(stiffness) + " N/mm: ", tally);
      });
}

LawResult checked(LawId id, const Run& run, const Done& done) {
  const CertifyOptions& options = run.options;
  const Calls calls = options.calls.law(id, options.parameters);
  const Subject subject{std::get<reference::Law>(reference::Law::build(id, options.parameters)), renderer_of(calls)};
  const auto source = [&](std::uint64_t seed) { return PositionSource(subject.law, seed); };
  LawResult result{run.at_points(calls, subject.law, source, first_part(done)), id, options.parameters};
  result.spread = spread_of(id, run, second_part(done));
  if (run.stop) return result;
  result.properties = run_properties(subject, options.cases, options.seed, run.on_case(name_of(id)));
  const Shape shape(subject.law);
  result.jumps = shape.jumps();
  result.conservative = reference::potential(subject.law).has_value();
  for (const float depth : witness_depths(subject)) {
    if (run.stop) return result;
    const WitnessLoop loop = witness_loop(subject.law, depth);
    result.energy.push_back(
        {static_cast<double>(depth), loop.bound_mJ, loop.paid_mJ, work_around(subject, shape, loop.vertices).rendered});
  }
  return result;
}

HeightMapResult checked(const NamedHeightMap& named, const Run& run, const Done& done) {
  const CertifyOptions& options = run.options;
  const auto& [file, map, rendering] = named;
  const float stiffness = options.parameters.stiffness;
  const Calls calls = options.calls.height_map(map, rendering, stiffness);
  const HeightSubject subject{std::get<reference::HeightMapField>(reference::HeightMapField::build(map, rendering, stiffness)),
                              renderer_of(calls)};
  const HeightShape shape(subject.law);
  const auto source = [&](std::uint64_t seed) { return HeightPositionSource(subject.law, shape, seed); };
  HeightMapResult result{run.at_points(calls, subject.law, source, first_part(done)), made_plain(file),
                         identity_of(map, rendering, stiffness), words_of(map)};
  result.spread = spread_of(named, shape, run, second_part(done));
  if (run.stop) return result;
  for (PropertyResult& property : run_properties(subject, options.cases, options.seed, run.on_case(file)))
    if (std::find(kPropertyNames.begin(), kPropertyNames.end(), property.name) != kPropertyNames.end())
      result.properties.push_back(std::move(property));
  result.jumps = shape.jumps();
  result.conservative = shape.is_conservative;
  if (run.stop) return result;
  // What done() is told counts the points; the loops are the tenth that is left.
  const reference::Watch watch([&](double share) { done(1 + share / 9); }, run.stop);
  try {
    add_loop_energies(result, [&] {
      return loop_energies(subject.law, std::get<fast::HeightMapField>(fast::HeightMapField::build(map, rendering, stiffness)),
                           watch);
    });
  } catch (const reference::Interrupted&) {  // `stop` is set, and nothing is certified
  }
  return result;
}

}  // namespace

std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw std::runtime_error(std::string("nothing can be certified: ") + fault);
  const auto start = std::chrono::steady_clock::now();
  Certificate certificate{current_build(), options.seed, 0, {}, {}};
  certificate.processor = processor_name();
  const auto all = static_cast<double>(options.laws.size() + options.height_maps.size());
  double before = 0;
  const auto check = [&](const auto& what, std::string_view name, auto& results) {
    const Run run{options, stop};
    // The points are most of the work; the properties and loops that follow are counted as a tenth of it.
    results.push_back(checked(what, run, [&](double done) { progress(name, (before + 0.9 * done) / all); }));
    progress(name, ++before / all);
  };
  for (std::size_t i = 0; i < options.laws.size() && !stop; ++i)
    check(options.laws[i], name_of(options.laws[i]), certificate.laws);
  for (std::size_t i = 0; i < options.height_maps.size() && !stop; ++i)
    check(options.height_maps[i], options.height_maps[i].file, certificate.height_maps);
  if (stop) return std::nullopt;
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  certificate.date = utc_now();
  return certificate;
}

}  // namespace forceshade::properties
