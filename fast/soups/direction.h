// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Directions from what they are made of, of any length.

#include <algorithm>
#include <cmath>

#include "fast/soups/points.h"

namespace forceshade::fast::soups {

// A direction of a line: from vertex a to vertex b, or along the line of two triangles' planes.
struct Line {
  const float *a = nullptr, *b = nullptr;
  std::array<std::uint32_t, 2> names{kNone, kNone};  // of a and b
  const Face *f = nullptr, *h = nullptr;             // n_f x n_h
  int sign = 1;

  static Line of_side(const Face& f, std::size_t i, int sign) noexcept {
    const std::size_t j = i == 2 ? 0 : i + 1;
    Line line;
    line.a = f.corner[sign > 0 ? i : j].data();
    line.b = f.corner[sign > 0 ? j : i].data();
    line.names = {f.vertex[sign > 0 ? i : j], f.vertex[sign > 0 ? j : i]};
    return line;
  }
  static Line of_planes(const Face& f, const Face& h, int sign) noexcept {
    Line line;
    line.f = &f;
    line.h = &h;
    line.sign = sign;
    return line;
  }
  bool is_edge() const noexcept { return a != nullptr; }
  Line reversed() const noexcept {
    Line line = *this;
    std::swap(line.a, line.b);
    std::swap(line.names[0], line.names[1]);
    line.sign = -sign;
    return line;
  }
  // True where it is known, not only where it is so.
  bool is_known_as(const Line& other) const noexcept {
    return is_edge() ? other.is_edge() && names == other.names
                     : !other.is_edge() && f == other.f && h == other.h && sign == other.sign;
  }
  bool is_side(const Face& face, std::size_t i) const noexcept {
    const std::uint32_t one = face.vertex[i], two = face.vertex[i == 2 ? 0 : i + 1];
    return is_edge() && ((one == names[0] && two == names[1]) || (one == names[1] && two == names[0]));
  }
  bool is_known_in_plane(const Face& face) const noexcept {
    if (!is_edge()) return &face == f || &face == h;
    const auto has = [&](std::uint32_t name) { return std::ranges::find(face.vertex, name) != face.vertex.end(); };
    return has(names[0]) && has(names[1]);
  }

  template <class N>
  Vector3<N> get() const noexcept {
    if (is_edge()) return corner_point<N>(b) - corner_point<N>(a);
    return signed_by<N>(sign, cross(normal<N>(*f), normal<N>(*h)));
  }
};

inline Ball larger(const Ball& a, const Ball& b) noexcept {
  return {std::max(a.value, b.value), std::max(a.error, b.error)};
}
inline Whole larger(const Whole& a, const Whole& b) noexcept {
  return (a - b).sign() >= 0 ? a : b;
}
inline Ball size_of(const Ball& a) noexcept {
  return {std::fabs(a.value), a.error};
}
inline Whole size_of(const Whole& a) noexcept {
  return a.sign() < 0 ? -a : a;
}
template <class N>
N largest_size(const Vector3<N>& a) noexcept {
  return larger(larger(size_of(a.x), size_of(a.y)), size_of(a.z));
}

struct Direction {
  enum class Kind { none, line, normal, sum, across, wedge, given };

  Kind kind = Kind::none;
  int sign = 1;
  Line line, other;                       // sum: of the two, each divided by its largest coordinate
  const Face *f = nullptr, *h = nullptr;  // normal: of f. across: n_f x line. wedge: (± n_f ± n_h) x line
  int sign_f = 1, sign_h = 1;
  const Vector3<Whole>* given = nullptr;
  const Face* in_plane = nullptr;  // it lies in this triangle's plane, where that is known
  Vector3<Ball> about{};

  static Direction along(const Line& line) noexcept {
    Direction d;
    d.kind = Kind::line;
    d.line = line;
    return d.with_about();
  }
  static Direction normal_of(const Face& f, int sign) noexcept {
    Direction d;
    d.kind = Kind::normal;
    d.f = &f;
    d.sign = sign;
    return d.with_about();
  }
  static Direction sum_of(const Line& one, const Line& two, int sign) noexcept {
    Direction d;
    d.kind = Kind::sum;
    d.line = one;
    d.other = two;
    d.sign = sign;
    return d.with_about();
  }
  static Direction across(const Face& f, const Line& line) noexcept {
    Direction d;
    d.kind = Kind::across;
    d.f = &f;
    d.line = line;
    return d.with_about();
  }
  static Direction wedge(const Face& f, int sign_f, const Face& h, int sign_h, const Line& line) noexcept {
    Direction d;
    d.kind = Kind::wedge;
    d.f = &f;
    d.h = &h;
    d.sign_f = sign_f;
    d.sign_h = sign_h;
    d.line = line;
    return d.with_about();
  }
  // The vector outlives the direction.
  static Direction of(const Vector3<Whole>& given, const Vector3<Ball>& about) noexcept {
    Direction d;
    d.kind = Kind::given;
    d.given = &given;
    d.about = about;
    return d;
  }
  Direction operator-() const noexcept {
    Direction d = *this;
    d.about = -about;
    d.sign = -sign;
    return d;
  }

  // A line's direction, as one.
  Line as_line() const noexcept { return sign > 0 ? line : line.reversed(); }

  template <class N>
  Vector3<N> get() const noexcept {
    if constexpr (std::is_same_v<N, Ball>)
      return about;
    else
      return made<N>();
  }

 private:
  Direction with_about() const noexcept {
    Direction d = *this;
    d.about = made<Ball>();
    return d;
  }
  template <class N>
  Vector3<N> made() const noexcept {
    return signed_by<N>(sign, unsigned_one<N>());
  }
  template <class N>
  Vector3<N> unsigned_one() const noexcept {
    switch (kind) {
      case Kind::line: return line.get<N>();
      case Kind::normal: return fast::soups::normal<N>(*f);
      case Kind::sum: {
        const Vector3<N> one = line.get<N>(), two = other.get<N>();
        return largest_size(two) * one + largest_size(one) * two;
      }
      case Kind::across: return cross(fast::soups::normal<N>(*f), line.get<N>());
      case Kind::wedge:
        return cross(signed_by<N>(sign_f, fast::soups::normal<N>(*f)) + signed_by<N>(sign_h, fast::soups::normal<N>(*h)),
                     line.get<N>());
      default: break;
    }
    if constexpr (std::is_same_v<N, Whole>) return *given;
    return {};
  }
};

// A triangle's normal.
struct NormalOf {
  explicit NormalOf(const Face& its) noexcept : face(&its), about(normal<Ball>(its)) {}

  const Face* face;
  Vector3<Ball> about;

  template <class N>
  Vector3<N> get() const noexcept {
    if constexpr (std::is_same_v<N, Ball>)
      return about;
    else
      return normal<Whole>(*face);
  }
};

template <class A, class B>
int sign_of_dot(const A& a, const B& b) noexcept {
  return sign_of([&]<class N>() { return dot(a.template get<N>(), b.template get<N>()); });
}

template <class A, class B>
bool are_parallel(const A& a, const B& b) noexcept {
  const Vector3<Ball> about = cross(a.template get<Ball>(), b.template get<Ball>());
  if (about.x.is_sure() || about.y.is_sure() || about.z.is_sure()) return false;
  note_exact_decision();
  const Vector3<Whole> exact = cross(a.template get<Whole>(), b.template get<Whole>());
  return exact.x.is_zero() && exact.y.is_zero() && exact.z.is_zero();
}

}  // namespace forceshade::fast::soups
