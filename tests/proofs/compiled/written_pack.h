// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Packs that write down what is done with them, as tests/proofs/written_number.h does: a Pack, Floats and a Watch in the sense
// of fast/simd/pack_avx2.h, with two positions side by side, whose coordinates are both called x and z. What is stored is kept
// by its address, so that the whole of `answer` runs as it stands.

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "fast/simd/batch.h"
#include "tests/proofs/written_number.h"

namespace forceshade::tests {

// Keeps what one run stores, and what it watches.
struct WrittenRun {
  std::map<const void*, std::size_t> stored;
  std::set<std::pair<std::string, std::size_t>> watched;  // a hazard's name, and the number that is looked at
  int window = 0;
  float least_coordinate = 0;
  double least_distance = 0;

  WrittenRun() { current = this; }
  WrittenRun(const WrittenRun&) = delete;
  WrittenRun& operator=(const WrittenRun&) = delete;
  ~WrittenRun() { current = nullptr; }

  static inline WrittenRun* current = nullptr;
};

// One lane: a term.
struct Lane {
  std::size_t node;

  static Lane constant(double value) { return {Writing::current().node(Writing::current().constant(value))}; }
  static Lane at(const void* from) { return {WrittenRun::current->stored.at(from)}; }
  void keep(const void* to) const { WrittenRun::current->stored[to] = node; }
  void watch(const char* hazard) const { WrittenRun::current->watched.insert({hazard, node}); }

  template <class... Operand>
  static Lane of(const char* operation, Operand... operands) {
    return {Writing::current().node(operation, {operands.node...})};
  }
};

}  // namespace forceshade::tests

namespace forceshade::fast {
namespace {

using tests::Lane;

struct Pack {
  static constexpr std::size_t kLanes = 1;
  struct Mask {
    Lane lane;
  };

  Lane lane;

  explicit Pack(double a) : lane(Lane::constant(a)) {}
  explicit Pack(Lane a) : lane(a) {}
  static Pack load(const double* from) { return Pack(Lane::at(from)); }
  static Pack load(const float* from) { return Pack(Lane::of("widened %", Lane::at(from))); }
  void store(double* to) const { lane.keep(to); }

  friend Pack operator+(Pack a, Pack b) { return Pack(Lane::of("plus % %", a.lane, b.lane)); }
  friend Pack operator-(Pack a, Pack b) { return Pack(Lane::of("minus % %", a.lane, b.lane)); }
  friend Pack operator*(Pack a, Pack b) { return Pack(Lane::of("times % %", a.lane, b.lane)); }
  friend Pack operator-(Pack a) { return Pack(Lane::of("opp %", a.lane)); }
  friend Mask operator<=(Pack a, Pack b) { return {Lane::of("is_at_most % %", a.lane, b.lane)}; }
  friend Pack fused_add(Pack a, Pack b, Pack c) { return Pack(Lane::of("fused % % %", a.lane, b.lane, c.lane)); }
  friend Pack fused_subtract_from(Pack a, Pack b, Pack c) { return fused_add(-a, b, c); }
  friend Pack fused_less(Pack a, Pack b, Pack c) { return fused_add(a, b, -c); }
  friend Pack square_root(Pack a) { return Pack(Lane::of("square_root %", a.lane)); }
  friend Pack larger(Pack a, Pack b) { return Pack(Lane::of("larger % %", a.lane, b.lane)); }
  friend Pack select(Mask condition, Pack yes, Pack no) {
    return Pack(Lane::of("if % then % else %", condition.lane, yes.lane, no.lane));
  }
};

struct Floats {
  static constexpr std::size_t kLanes = 2;
  struct Mask {
    Lane first, second;
    friend Mask operator&(Mask a, Mask b) { return of("andb % %", a, b); }
    friend Mask operator|(Mask a, Mask b) { return of("orb % %", a, b); }
    template <class... Operand>
    static Mask of(const char* operation, Operand... operands) {
      return {Lane::of(operation, operands.first...), Lane::of(operation, operands.second...)};
    }
  };

  Lane first, second;

  Floats(Lane a, Lane b) : first(a), second(b) {}
  explicit Floats(double a) : first(Lane::of("rounded %", Lane::constant(a))), second(first) {}
  explicit Floats(float a) : Floats(static_cast<double>(a)) {}
  static Floats load(const float* from) { return {Lane::at(from), Lane::at(from + 1)}; }
  void store(float* to) const {
    first.keep(to);
    second.keep(to + 1);
  }
  Pack first_half() const { return Pack(Lane::of("widened %", first)); }
  Pack second_half() const { return Pack(Lane::of("widened %", second)); }
  static Floats rounded(Pack first, Pack second) {
    return {Lane::of("rounded %", first.lane), Lane::of("rounded %", second.lane)};
  }

  template <class... Operand>
  static Floats of(const char* operation, Operand... operands) {
    return {Lane::of(operation, operands.first...), Lane::of(operation, operands.second...)};
  }
  friend Floats operator+(Floats a, Floats b) { return of("plus32 % %", a, b); }
  friend Floats operator-(Floats a, Floats b) { return of("minus32 % %", a, b); }
  friend Floats operator*(Floats a, Floats b) { return of("times32 % %", a, b); }
  friend Floats operator/(Floats a, Floats b) { return of("over32 % %", a, b); }
  friend Floats square_root(Floats a) { return of("square_root32 %", a); }
  friend Floats absolute(Floats a) { return of("absolute32 %", a); }
  friend Floats larger(Floats a, Floats b) { return of("larger32 % %", a, b); }
  friend Floats times_sign(Floats a, Floats b) { return of("times_sign32 % %", a, b); }
  friend Floats select(Mask condition, Floats yes, Floats no) { return of("choice32 % % %", condition, yes, no); }
  friend Floats operator&(Floats a, Mask condition) { return of("where32 % %", condition, a); }
  friend Mask operator<(Floats a, Floats b) { return Mask::of("is_less32 % %", a, b); }
  friend Mask operator<=(Floats a, Floats b) { return Mask::of("is_at_most32 % %", a, b); }
  friend Mask operator>(Floats a, Floats b) { return b < a; }
  friend Mask operator==(Floats a, Floats b) { return Mask::of("is_equal32 % %", a, b); }
};

struct Watch {
  void domain(Floats a, Floats b) {
    for (const Lane lane : {a.first, a.second, b.first, b.second}) lane.watch("domain");
  }
  void tiny(Floats size) {
    size.first.watch("tiny");
    size.second.watch("tiny");
  }
  void coordinates(Floats a, Floats b) {
    domain(a, b);
    tiny(a);
    tiny(b);
  }
  void distance(Pack first, Pack second) {
    first.lane.watch("distance");
    second.lane.watch("distance");
  }
  void doubt(Floats::Mask where) {
    where.first.watch("doubt");
    where.second.watch("doubt");
  }
  template <int kWindow>
  void rounding(Pack first, Pack second) {
    first.lane.watch("rounding");
    second.lane.watch("rounding");
  }
  template <int kWindow>
  bool is_free_of_hazards(float least_coordinate, double least_distance) const {
    tests::WrittenRun::current->window = kWindow;
    tests::WrittenRun::current->least_coordinate = least_coordinate;
    tests::WrittenRun::current->least_distance = least_distance;
    return true;
  }
};

}  // namespace
}  // namespace forceshade::fast

// The forms made of packs:
#include "fast/simd/form_of.inl"
