// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The work of certify, divided into units that any thread, process or machine may do: what a unit finds depends on nothing but
// the work and the build.

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/tally.h"
#include "forceshade/certify.h"

namespace forceshade::properties {

// points: chunks of positions with the given parameters; spread: sets of drawn parameters; properties and energies: one part
// for all of a subject; sweep: blocks of 2^22 bit patterns with both signs (kUnitsPerSweep).
enum class ItemKind { points, spread, properties, energies, sweep };
inline constexpr std::array<std::string_view, 5> kItemKinds{"points", "spread", "properties", "energies", "sweep"};

// One method, applied to one subject or sweep.
struct Item {
  ItemKind kind = ItemKind::points;
  std::size_t of = 0;  // the number of the subject or of the sweep
  std::uint64_t parts = 1;
};

// Consecutive parts of one item.
struct Unit {
  std::size_t item = 0;
  std::uint64_t first = 0, end = 0;

  friend bool operator==(const Unit&, const Unit&) = default;
};

// Items cut into units of at most so many parts; without a list, because there may be millions.
class Units {
 public:
  Units(std::vector<Item> items, std::uint64_t parts_of_a_unit);

  std::uint64_t count() const { return begins_.back(); }
  Unit at(std::uint64_t number) const;  // number: below count()
  const std::vector<Item>& items() const { return items_; }

 private:
  std::vector<Item> items_;
  std::uint64_t size_;
  std::vector<std::uint64_t> begins_;  // of the units of each item, and the end
};

// The energies of loops, or the reason for their absence.
struct Energies {
  std::vector<LoopEnergy> loops = {};
  std::string fault = {};
};

// The results of one unit, or of several of one item.
struct Found {
  Tally tally = {};                             // of points, spread and sweep
  std::vector<PropertyResult> properties = {};  // the four of a certificate
  Energies energies = {};

  void add(const Found& other);  // in any order
};

class DividedWork {
 public:
  // what: subjects, points, cases and seed count. Both outlive this.
  DividedWork(const CertifyOptions& what, const Sweeps& sweeps) : what_(what), sweeps_(sweeps) {}

  // Those of each subject in turn, and then those of the sweeps.
  std::vector<Item> items() const;
  Item item(ItemKind kind, std::size_t of) const;

  // One part of an item whose findings are counted.
  void count(const Item& item, std::uint64_t part, Tally& tally) const;
  // The results that are not counted, of one subject. They are void where `stop` is set in the meantime.
  std::vector<PropertyResult> properties(std::size_t of, const OnCase& on_case, const std::atomic<bool>& stop) const;
  Energies energies(std::size_t of, const Monitor& monitor) const;

  // A whole unit of one of items(). Says nothing where `stop` is set in the meantime.
  Found found(const Item& item, std::uint64_t first, std::uint64_t end, const std::atomic<bool>& stop) const;

 private:
  const Subject& subject(std::size_t of) const { return *what_.subjects[of]; }
  std::uint64_t stream(std::uint64_t chunk) const;
  std::uint64_t spread_stream(std::uint64_t chunk) const;

  const CertifyOptions& what_;
  const Sweeps& sweeps_;
};

// The part of a certificate for one subject, from the results of its items in the order of DividedWork::items().
SubjectResult result_of(const Subject& subject, std::uint64_t seed, const std::array<Found, 4>& found,
                        std::uint64_t parameter_sets);

// The certificate, but for what a run knows of itself, from what each of the items found; `sweeps` with next set.
Certificate assembled(const CertifyOptions& what, Sweeps sweeps, const Units& units, const std::vector<Found>& found,
                      const std::vector<std::uint64_t>& parts_done);

}  // namespace forceshade::properties
