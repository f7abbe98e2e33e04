// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/certify.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <tuple>

#include "forceshade/fast/law.h"
#include "forceshade/properties/binary32.h"
#include "forceshade/properties/build.h"
#include "forceshade/properties/equivalence.h"
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
  std::uint64_t points = 0, mismatches = 0;
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
    mismatches += other.mismatches;
    call(other.closest_call);
    for (const std::string& words : other.counterexamples)
      if (counterexamples.size() < kCounterexamples) counterexamples.push_back(words);
  }
};

// One chunk: every point by the scalar call against the reference, then all of them by every vector set against that.
void check_chunk(const fast::Law& law, const reference::Law& reference, std::uint64_t seed, std::uint64_t count, Tally& tally) {
  PositionSource source(reference, seed);
  std::array<float, kChunk> x{}, z{}, fx{}, fz{}, batch_fx{}, batch_fz{};
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [position, aim] = source.next();
    const fast::Evaluation answer = law.evaluate(position);
    const reference::Rounded exact = reference.round_to_binary32(position);
    ++tally.points;
    ++tally.aims[static_cast<std::size_t>(aim)];
    ++tally.stages[static_cast<std::size_t>(answer.stage)];
    ++tally.methods[static_cast<std::size_t>(exact.method)];
    ++tally.statuses[static_cast<std::size_t>(exact.status)];
    if (exact.ulps_from_tie > 0)
      tally.call({position.x(), position.y(), position.z(), static_cast<double>(exact.ulps_from_tie)});
    if (auto words = difference(position, {answer.force, answer.status}, exact)) tally.mismatch(std::move(*words));
    // The batch call knows no y: a position refused for its y alone is sent as one refused for its x.
    x[i] = exact.status == Status::invalid ? std::numeric_limits<float>::quiet_NaN() : position.x();
    z[i] = position.z();
    fx[i] = answer.force.x();
    fz[i] = answer.force.z();
  }
  for (const fast::InstructionSet set : fast::kInstructionSets) {
    if (!fast::is_available(set)) continue;
    law.force(std::span(x).first(count), std::span(z).first(count), std::span(batch_fx).first(count),
              std::span(batch_fz).first(count), set);
    for (std::uint64_t i = 0; i < count; ++i)
      if (!same_bits(fx[i], batch_fx[i]) || !same_bits(fz[i], batch_fz[i]))
        tally.mismatch("at x = " + show(x[i]) + ", z = " + show(z[i]) + " mm: the batch call (" +
                       std::string(fast::name_of(set)) + ") gives (" + show(batch_fx[i]) + ", " + show(batch_fz[i]) +
                       "), the scalar call (" + show(fx[i]) + ", " + show(fz[i]) + ") N");
  }
}

Tally check_points(const fast::Law& law, const reference::Law& reference, const CertifyOptions& options,
                   const std::function<void(double)>& progress, const std::atomic<bool>& stop) {
  const std::uint64_t chunks = (options.points + kChunk - 1) / kChunk;
  std::atomic<std::uint64_t> next{0};
  std::mutex mutex;
  Tally total;
  std::uint64_t finished = 0;
  const auto work = [&] {
    Tally mine;
    for (std::uint64_t chunk = next++; chunk < chunks && !stop; chunk = next++) {
      // Streams are told apart by the golden ratio's odd multiple: no two chunks or seeds in reach share one.
      const std::uint64_t seed = (options.seed + 1) * 0x9E3779B97F4A7C15U + chunk;
      check_chunk(law, reference, seed, std::min(kChunk, options.points - chunk * kChunk), mine);
      const std::lock_guard lock(mutex);
      progress(static_cast<double>(++finished) / static_cast<double>(chunks));
    }
    const std::lock_guard lock(mutex);
    total.add(mine);
  };
  std::vector<std::jthread> threads;
  for (unsigned i = 1; i < options.threads; ++i) threads.emplace_back(work);
  work();
  threads.clear();
  return total;
}

template <std::size_t kCount>
std::map<std::string, std::uint64_t> named(const std::array<std::uint64_t, kCount>& counts,
                                           const std::array<std::string, kCount>& names) {
  std::map<std::string, std::uint64_t> result;
  for (std::size_t i = 0; i < kCount; ++i) result[names[i]] = counts[i];
  return result;
}

}  // namespace

std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw std::runtime_error(std::string("nothing can be certified: ") + fault);
  const auto start = std::chrono::steady_clock::now();
  Certificate certificate{current_build(), options.seed, 0, {}, {}};
  for (std::size_t i = 0; i < options.laws.size(); ++i) {
    const LawId id = options.laws[i];
    const auto overall = [&](double done) {
      return (static_cast<double>(i) + done) / static_cast<double>(options.laws.size());
    };
    const Subject subject = std::get<Subject>(fast_subject(id, options.parameters));
    const fast::Law law = std::get<fast::Law>(fast::Law::build(id, options.parameters));

    // The points are most of the work; the properties and loops that follow are counted as a tenth of it.
    const Tally tally = check_points(
        law, subject.law, options, [&](double done) { progress(id, overall(0.9 * done)); }, stop);
    if (stop) return std::nullopt;

    LawResult result;
    result.law = id;
    result.parameters = options.parameters;
    result.points = tally.points;
    result.mismatches = tally.mismatches;
    for (std::size_t aim = 0; aim < kAims; ++aim)
      result.points_by_aim[std::string(name_of(static_cast<Aim>(aim)))] = tally.aims[aim];
    result.points_by_stage = named(tally.stages, {"binary64", "double-double", "wide"});
    result.points_by_method = named(tally.methods, {"filter", "enclosure", "exact"});
    result.points_by_status = named(tally.statuses, {"free", "contact", "invalid"});
    result.closest_call = tally.closest_call;
    result.counterexamples = tally.counterexamples;
    result.properties = run_properties(subject, options.cases, options.seed);
    const Shape shape(subject.law);
    result.jumps = shape.jumps();
    result.conservative = reference::potential(subject.law).has_value();
    for (const float depth : witness_depths(subject)) {
      const WitnessLoop loop = witness_loop(subject.law, depth);
      result.energy.push_back(
          {static_cast<double>(depth), loop.bound_mJ, loop.paid_mJ, work_around(subject, shape, loop.vertices).rendered});
    }
    if (stop) return std::nullopt;
    certificate.laws.push_back(std::move(result));
    progress(id, overall(1));
  }
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return certificate;
}

}  // namespace forceshade::properties
