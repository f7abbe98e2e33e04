// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/work.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "certificate/compare.h"
#include "certificate/sweep_unit.h"
#include "files/printable.h"
#include "forceshade/properties.h"
#include "properties/kind_of_library.h"
#include "reference/height_energy.h"

namespace forceshade::properties {
namespace {

constexpr std::uint64_t kChunk = 4096;  // points from one stream, one path

}  // namespace

Units::Units(std::vector<Item> items, std::uint64_t parts_of_a_unit) : items_(std::move(items)), size_(parts_of_a_unit) {
  begins_.push_back(0);
  for (const Item& item : items_) begins_.push_back(begins_.back() + (item.parts + size_ - 1) / size_);
}

Unit Units::at(std::uint64_t number) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), number);
  const auto item = static_cast<std::size_t>(std::distance(begins_.begin(), after)) - 1;
  const std::uint64_t first = (number - begins_[item]) * size_;
  return {item, first, std::min(first + size_, items_[item].parts)};
}

void Found::add(const Found& other) {
  tally.add(other.tally);
  properties.insert(properties.end(), other.properties.begin(), other.properties.end());
  energies.loops.insert(energies.loops.end(), other.energies.loops.begin(), other.energies.loops.end());
  energies.fault += other.energies.fault;
}

// An odd multiple from the golden ratio separates the streams: no two chunks or seeds in reach share one.
std::uint64_t DividedWork::stream(std::uint64_t chunk) const {
  return (what_.seed + 1) * 0x9E3779B97F4A7C15U + chunk;
}

// The stream of the spread is as far from those as can be.
std::uint64_t DividedWork::spread_stream(std::uint64_t chunk) const {
  return stream(chunk) ^ 0x8000000000000000U;
}

Item DividedWork::item(ItemKind kind, std::size_t of) const {
  const std::uint64_t spread = spread_points(what_.points);
  switch (kind) {
    case ItemKind::points: return {kind, of, (what_.points + kChunk - 1) / kChunk};
    case ItemKind::spread: {
      const std::uint64_t size = subject(of).points_of_a_set(spread);
      return {kind, of, (spread + size - 1) / size};
    }
    case ItemKind::sweep: return {kind, of, kUnitsPerSweep};
    default: return {kind, of, 1};
  }
}

std::vector<Item> DividedWork::items() const {
  std::vector<Item> all;
  for (std::size_t of = 0; of < what_.subjects.size(); ++of)
    for (const ItemKind kind : {ItemKind::points, ItemKind::spread, ItemKind::properties, ItemKind::energies})
      all.push_back(item(kind, of));
  for (std::size_t of = 0; of < sweeps_.results.size(); ++of) all.push_back(item(ItemKind::sweep, of));
  return all;
}

void DividedWork::count(const Item& item, std::uint64_t part, Tally& tally) const {
  if (item.kind == ItemKind::points) {
    compare_chunk(subject(item.of), stream(part), std::min(kChunk, what_.points - part * kChunk), part, "", tally);
  } else if (item.kind == ItemKind::spread) {
    const std::uint64_t points = spread_points(what_.points), size = subject(item.of).points_of_a_set(points);
    const std::uint64_t seed = spread_stream(part);
    const DrawnSubject drawn = subject(item.of).with_drawn_parameters(seed);
    compare_chunk(*drawn.subject, seed, std::min(size, points - part * size), part, drawn.parameters, tally);
  } else {
    tally.add(check_unit(sweeps_.results[item.of].sweep, static_cast<std::uint32_t>(part)));
  }
}

std::vector<PropertyResult> DividedWork::properties(std::size_t of, const OnCase& on_case,
                                                    const std::atomic<bool>& stop) const {
  std::vector<PropertyResult> all = run_properties(subject(of), what_.cases, what_.seed, nullptr, on_case, &stop);
  std::erase_if(all, [](const PropertyResult& property) {
    return std::find(kPropertyNames.begin(), kPropertyNames.end(), property.name) == kPropertyNames.end();
  });
  return all;
}

Energies DividedWork::energies(std::size_t of, const Monitor& monitor) const {
  try {
    return {subject(of).energies(monitor)};
  } catch (const reference::NotEnclosed& error) {
    return {{}, std::string("the energy that a loop can give is ") + error.what()};
  } catch (const RendererThrew& error) {
    return {{}, error.what()};
  } catch (const Interrupted&) {  // `stop` is set, and nothing is certified
    return {};
  }
}

Found DividedWork::found(const Item& item, std::uint64_t first, std::uint64_t end, const std::atomic<bool>& stop) const {
  Found found;
  if (item.kind == ItemKind::properties)
    found.properties = properties(item.of, nullptr, stop);
  else if (item.kind == ItemKind::energies)
    found.energies = energies(item.of, Monitor([](double) {}, stop));
  else
    for (std::uint64_t part = first; part < end && !stop; ++part) count(item, part, found.tally);
  return found;
}

SubjectResult result_of(const Subject& subject, std::uint64_t seed, const std::array<Found, 4>& found,
                        std::uint64_t parameter_sets) {
  const auto& [points, spread, properties, energies] = found;
  // Either may throw, while a list of initialisers would be half built.
  Identity identity = subject.identity();
  auto parts = subject.parts();
  SubjectResult result{{points.tally.comparison()}, std::move(identity), std::move(parts)};
  result.closest_call = points.tally.closest_call;
  result.spread = {spread.tally.comparison(), parameter_sets};
  result.seeds = {seed};
  result.identity.name = files::printable(result.identity.name);
  result.properties = properties.properties;
  result.rendered_by = is_rendered_by_library(subject) ? RenderedBy::library : RenderedBy::program;
  const Expected expected = subject.expected();
  result.jumps = expected.jumps;
  result.conservative = expected.is_conservative;
  result.unit_directions = expected.has_unit_directions && result.has_held("unit normals");
  result.energy = energies.energies.loops;
  // No number is certified if the energies are not enclosed, or the renderer throws: passivity has failed, and its
  // counterexample says why.
  for (PropertyResult& property : result.properties) {
    if (property.name != "passivity" || energies.energies.fault.empty()) continue;
    property.held = false;
    property.counterexample += (property.counterexample.empty() ? "" : "; ") + energies.energies.fault;
  }
  return result;
}

Certificate assembled(const CertifyOptions& what, Sweeps sweeps, const Units& units, const std::vector<Found>& found,
                      const std::vector<std::uint64_t>& parts_done) {
  Certificate certificate{current_build(), 0, {}, {}};
  for (std::size_t item = 0; item < found.size(); ++item) {
    const Item& its = units.items()[item];
    if (its.kind == ItemKind::points)
      certificate.subjects.push_back(result_of(*what.subjects[its.of], what.seed,
                                               {found[item], found[item + 1], found[item + 2], found[item + 3]},
                                               parts_done[item + 1]));
    if (its.kind == ItemKind::sweep) add(sweeps, its.of, found[item].tally);
  }
  certificate.sweeps = std::move(sweeps);
  return certificate;
}

}  // namespace forceshade::properties
