// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/certify.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "forceshade/fast/height_law.h"
#include "forceshade/fast/law.h"
#include "forceshade/properties/binary32.h"
#include "forceshade/properties/build.h"
#include "forceshade/properties/equivalence.h"
#include "forceshade/properties/height_loops.h"
#include "forceshade/properties/height_positions.h"
#include "forceshade/properties/passivity.h"
#include "forceshade/properties/positions.h"
#include "forceshade/properties/run.h"
#include "forceshade/reference/energy.h"

namespace forceshade::properties {
namespace {

constexpr std::uint64_t kChunk = 4096;  // points from one stream
constexpr std::size_t kCounterexamples = 10;

// What one thread has seen of one law.
struct Tally {
  std::array<std::uint64_t, kAims> aims{};
  std::array<std::uint64_t, 3> stages{}, methods{}, statuses{};
  std::uint64_t points = 0, undecided = 0, mismatches = 0;
  ClosestCall closest_call;
  std::vector<std::string> counterexamples;

  void mismatch(std::string words) {
    ++mismatches;
    if (counterexamples.size() < kCounterexamples) counterexamples.push_back(std::move(words));
  }

  // Of two equally close ones the smaller position stands, so that the order of threads does not matter.
  void call(const ClosestCall& other) {
    const auto key = [](const ClosestCall& c) { return std::tuple(c.ulps_from_tie, c.x, c.y, c.z); };
    if (key(other) < key(closest_call)) closest_call = other;
  }

  void add(const Tally& other) {
    const auto sum = [](auto& into, const auto& from) {
      std::transform(into.begin(), into.end(), from.begin(), into.begin(), std::plus<>());
    };
    sum(aims, other.aims);
    sum(stages, other.stages);
    sum(methods, other.methods);
    sum(statuses, other.statuses);
    points += other.points;
    undecided += other.undecided;
    mismatches += other.mismatches;
    call(other.closest_call);
    for (const std::string& words : other.counterexamples)
      if (counterexamples.size() < kCounterexamples) counterexamples.push_back(words);
  }
};

std::vector<Eigen::Vector3f> batch(const fast::HeightLaw& law, const std::vector<Eigen::Vector3f>& positions,
                                   fast::InstructionSet set) {
  std::vector<Eigen::Vector3f> forces(positions.size());
  law.force(positions, forces, set);
  return forces;
}

// This batch call knows no y: a position refused for its y alone is sent as one refused for its x.
std::vector<Eigen::Vector3f> batch(const fast::Law& law, const std::vector<Eigen::Vector3f>& positions,
                                   fast::InstructionSet set) {
  std::vector<float> x, z, fx(positions.size()), fz(positions.size());
  for (const Eigen::Vector3f& position : positions) {
    x.push_back(std::fabs(position.y()) <= 1e4F ? position.x() : std::numeric_limits<float>::quiet_NaN());
    z.push_back(position.z());
  }
  law.force(x, z, fx, fz, set);
  std::vector<Eigen::Vector3f> forces;
  for (std::size_t i = 0; i < positions.size(); ++i) forces.emplace_back(fx[i], 0, fz[i]);
  return forces;
}

bool same_force(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

// One chunk: every point by the scalar call against the reference, then all of them by every vector set against that.
template <class Fast, class Reference, class Source>
void check_chunk(const Fast& law, const Reference& reference, Source source, std::uint64_t count, Tally& tally) {
  std::vector<Eigen::Vector3f> positions, forces;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [position, aim] = source.next();
    const fast::Evaluation answer = law.evaluate(position);
    positions.push_back(position);
    forces.push_back(answer.force);
    reference::Rounded exact;
    try {
      exact = reference.round_to_binary32(position);
    } catch (const std::domain_error&) {  // parts of a height map that all but cancel
      ++tally.undecided;
      continue;
    }
    ++tally.points;
    ++tally.aims[static_cast<std::size_t>(aim)];
    ++tally.stages[static_cast<std::size_t>(answer.stage)];
    ++tally.methods[static_cast<std::size_t>(exact.method)];
    ++tally.statuses[static_cast<std::size_t>(exact.status)];
    if (exact.ulps_from_tie > 0)
      tally.call({position.x(), position.y(), position.z(), static_cast<double>(exact.ulps_from_tie)});
    if (auto words = difference(position, {answer.force, answer.status}, exact)) tally.mismatch(std::move(*words));
  }
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    const std::vector<Eigen::Vector3f> answers = batch(law, positions, set);
    for (std::uint64_t i = 0; i < count; ++i)
      if (!same_force(forces[i], answers[i]))
        tally.mismatch("at " + show(positions[i]) + " mm: the batch call (" + std::string(fast::name_of(set)) + ") gives " +
                       show(answers[i]) + ", the scalar call " + show(forces[i]) + " N");
  }
}

// source(seed): a stream of positions. Rethrows what a thread threw.
template <class Fast, class Reference, class MakeSource>
Tally check_points(const Fast& law, const Reference& reference, const MakeSource& source, const CertifyOptions& options,
                   const std::function<void(double)>& progress, const std::atomic<bool>& stop) {
  const std::uint64_t chunks = (options.points + kChunk - 1) / kChunk;
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Tally total;
  std::uint64_t finished = 0;
  std::exception_ptr thrown;
  const auto work = [&] {
    Tally mine;
    try {
      for (std::uint64_t chunk = next++; chunk < chunks && !stop; chunk = next++) {
        // Streams are told apart by the golden ratio's odd multiple: no two chunks or seeds in reach share one.
        const std::uint64_t seed = (options.seed + 1) * 0x9E3779B97F4A7C15U + chunk;
        check_chunk(law, reference, source(seed), std::min(kChunk, options.points - chunk * kChunk), mine);
        const std::lock_guard lock(mutex);
        progress(static_cast<double>(++finished) / static_cast<double>(chunks));
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
      next = chunks;
    }
    const std::lock_guard lock(mutex);
    total.add(mine);
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 1; i < options.threads; ++i) threads.emplace_back(work);
  work();
  threads.clear();
  if (thrown) std::rethrow_exception(thrown);
  return total;
}

template <std::size_t kCount>
std::map<std::string, std::uint64_t> named(const std::array<std::uint64_t, kCount>& counts,
                                           const std::array<std::string, kCount>& names) {
  std::map<std::string, std::uint64_t> result;
  for (std::size_t i = 0; i < kCount; ++i) result[names[i]] = counts[i];
  return result;
}

Findings findings_of(const Tally& tally) {
  Findings found;
  found.points = tally.points;
  found.undecided = tally.undecided;
  found.mismatches = tally.mismatches;
  for (std::size_t aim = 0; aim < kAims; ++aim)
    found.points_by_aim[std::string(name_of(static_cast<Aim>(aim)))] = tally.aims[aim];
  found.points_by_stage = named(tally.stages, {"binary64", "double-double", "wide"});
  found.points_by_method = named(tally.methods, {"filter", "enclosure", "exact"});
  found.points_by_status = named(tally.statuses, {"free", "contact", "invalid"});
  found.closest_call = tally.closest_call;
  found.counterexamples = tally.counterexamples;
  return found;
}

using Done = std::function<void(double)>;

LawResult checked(LawId id, const CertifyOptions& options, const Done& done, const std::atomic<bool>& stop) {
  const Subject subject = std::get<Subject>(fast_subject(id, options.parameters));
  const auto law = std::get<fast::Law>(fast::Law::build(id, options.parameters));
  const auto source = [&](std::uint64_t seed) { return PositionSource(subject.law, seed); };
  LawResult result{findings_of(check_points(law, subject.law, source, options, done, stop)), id, options.parameters};
  if (stop) return result;
  result.properties = run_properties(subject, options.cases, options.seed);
  const Shape shape(subject.law);
  result.jumps = shape.jumps();
  result.conservative = reference::potential(subject.law).has_value();
  for (const float depth : witness_depths(subject)) {
    const WitnessLoop loop = witness_loop(subject.law, depth);
    result.energy.push_back(
        {static_cast<double>(depth), loop.bound_mJ, loop.paid_mJ, work_around(subject, shape, loop.vertices).rendered});
  }
  return result;
}

HeightMapResult checked(const NamedHeightMap& named, const CertifyOptions& options, const Done& done,
                        const std::atomic<bool>& stop) {
  const auto& [file, map, rendering] = named;
  const float stiffness = options.parameters.stiffness;
  const HeightSubject subject = std::get<HeightSubject>(fast_subject(map, rendering, stiffness));
  const auto law = std::get<fast::HeightLaw>(fast::HeightLaw::build(map, rendering, stiffness));
  const HeightShape shape(subject.law);
  const auto source = [&](std::uint64_t seed) { return HeightPositionSource(subject.law, shape, seed); };
  HeightMapResult result{findings_of(check_points(law, subject.law, source, options, done, stop)), file,
                         identity_of(map, rendering, stiffness), words_of(map)};
  if (stop) return result;
  for (PropertyResult& property : run_properties(subject, options.cases, options.seed))
    if (std::find(kPropertyNames.begin(), kPropertyNames.end(), property.name) != kPropertyNames.end())
      result.properties.push_back(std::move(property));
  result.jumps = shape.jumps();
  result.conservative = shape.is_conservative;
  // What done() is told counts the points; the loops are the tenth that is left.
  const reference::Watch watch([&](double share) { done(1 + share / 9); }, stop);
  try {
    add_loop_energies(result, [&] { return loop_energies(subject.law, law, watch); });
  } catch (const reference::Interrupted&) {  // `stop` is set, and nothing is certified
  }
  return result;
}

}  // namespace

std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw std::runtime_error(std::string("nothing can be certified: ") + fault);
  const auto start = std::chrono::steady_clock::now();
  Certificate certificate{current_build(), options.seed, 0, {}, {}};
  const auto all = static_cast<double>(options.laws.size() + options.height_maps.size());
  double before = 0;
  const auto check = [&](const auto& what, std::string_view name, auto& results) {
    // The points are most of the work; the properties and loops that follow are counted as a tenth of it.
    results.push_back(checked(
        what, options, [&](double done) { progress(name, (before + 0.9 * done) / all); }, stop));
    progress(name, ++before / all);
  };
  for (std::size_t i = 0; i < options.laws.size() && !stop; ++i)
    check(options.laws[i], name_of(options.laws[i]), certificate.laws);
  for (std::size_t i = 0; i < options.height_maps.size() && !stop; ++i)
    check(options.height_maps[i], options.height_maps[i].file, certificate.height_maps);
  if (stop) return std::nullopt;
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return certificate;
}

}  // namespace forceshade::properties
