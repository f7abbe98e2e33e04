// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/god_object.h"

#include <algorithm>

#include "reference/larger_limits.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::reference::soups {
namespace {

using mesh::Meeting;

struct Kind {
  PlaceKind kind, of_foot;
  mesh::Place place;
  Meeting meeting;
  std::size_t indices, further, parameters;  // the numbers of each, in this order
};
// `crossing` has its corner before its parameter, as `line` of mesh::GodObject.
constexpr std::array kKinds{
    Kind{PlaceKind::free, PlaceKind::free, mesh::Place::free, Meeting::none, 0, 0, 0},
    Kind{PlaceKind::vertex, PlaceKind::free, mesh::Place::vertex, Meeting::none, 1, 0, 0},
    Kind{PlaceKind::edge, PlaceKind::free, mesh::Place::edge, Meeting::none, 2, 0, 1},
    Kind{PlaceKind::triangle, PlaceKind::free, mesh::Place::triangle, Meeting::none, 1, 0, 2},
    Kind{PlaceKind::crossing, PlaceKind::free, mesh::Place::triangle, Meeting::line, 2, 1, 1},
    Kind{PlaceKind::edges, PlaceKind::free, mesh::Place::edge, Meeting::edges, 2, 2, 0},
    Kind{PlaceKind::edge_and_triangle, PlaceKind::free, mesh::Place::edge, Meeting::edge_and_triangle, 2, 1, 0},
    Kind{PlaceKind::triangles, PlaceKind::free, mesh::Place::triangle, Meeting::triangles, 2, 1, 0},
    Kind{PlaceKind::foot, PlaceKind::triangle, mesh::Place::triangle, Meeting::foot_on_triangle, 1, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::edge, mesh::Place::edge, Meeting::foot_on_edge, 2, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::crossing, mesh::Place::triangle, Meeting::foot_on_line, 2, 1, 0}};

class SoupTicks final : public meshes::Ticks {
 public:
  explicit SoupTicks(const MeshRendering& rendering)
      : has_friction_(rendering.contact == mesh::Contact::friction),
        soup_(rendering.mesh(), {rendering.sides}, materials_of(rendering)),
        normals_(rendering.shading == mesh::Shading::vertex_scheme ? rendering.normals : mesh::CornerNormals()) {
    for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i) {
      const mesh::Material its = material_of(rendering.materials, i);
      stiffness_.push_back(its.stiffness.value_or(rendering.stiffness));
      damping_.push_back(its.damping);
    }
  }

  meshes::ExactTick tick(const mesh::GodObject& before, const std::array<float, 3>& position,
                         unsigned most_moves) const override {
    const Tick made = soups::tick(soup_, state_of(before), position, most_moves);
    meshes::ExactTick tick{{made.status, static_cast<std::uint16_t>(made.moves), {}, object_of(made.after)}, {}};
    tick.tick.after.is_slipping = has_friction_ && made.after.is_slipping;
    if (!made.rest) return tick;
    tick.force = exact_force(*made.rest, stiffness_at(*made.rest), normals_);
    tick.tick.damping = damping_at(*made.rest);
    return tick;
  }

 private:
  static std::vector<mesh::Material> materials_of(const MeshRendering& rendering) {
    std::vector<mesh::Material> all;
    if (!rendering.materials.list.empty())
      for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i) all.push_back(material_of(rendering.materials, i));
    return all;
  }
  // The largest of the triangles that hold r.
  float stiffness_at(const Rest& rest) const {
    float largest = 0;
    for (const Triangle* triangle : rest.r.star->triangles()) largest = std::max(largest, stiffness_[triangle->number]);
    return largest;
  }
  damping::Limits damping_at(const Rest& rest) const {
    damping::Limits largest{0, 0};
    for (const Triangle* triangle : rest.r.star->triangles()) enlarge(largest, damping_[triangle->number]);
    return largest;
  }

  bool has_friction_;
  Soup soup_;
  mesh::CornerNormals normals_;   // none: the force is not shaded
  std::vector<float> stiffness_;  // of each triangle of the file, N/mm
  std::vector<damping::Limits> damping_;
};

using Direction = std::optional<Vector>;
using Side = Star::Side;

class Shading {
 public:
  Shading(const Rest& rest, const mesh::CornerNormals& normals)
      : r_(rest.r.x), star_(*rest.r.star), cell_(rest.r.cell), D_n_(rest.D - rest.tangential), normals_(normals) {}

  // N, which the force is turned to; nothing where it is not turned.
  Direction direction() const {
    const Direction N = star_.kind() == Star::Kind::point  ? at_vertex()
                        : star_.kind() == Star::Kind::line ? on_line()
                                                           : in_plane();
    return N && dot(*N, D_n_) > 0 ? N : std::nullopt;
  }

 private:
  Vector corner(const Triangle& f, std::size_t i) const { return exact(normals_[f.number][i]); }
  static Vector exact(const mesh::Normal& n) { return {Rational(n[0]), Rational(n[1]), Rational(n[2])}; }
  static Vector seen(const Triangle& f, const Vector& up, const Vector& N) { return dot(f.normal, up) < 0 ? -N : N; }
  Vector interpolated(const Triangle& f) const {
    const auto [beta, gamma] = f.weights(r_);
    return (1 - beta - gamma) * corner(f, 0) + beta * corner(f, 1) + gamma * corner(f, 2);
  }
  std::vector<Side> walls() const {
    std::vector<Side> all = star_.sides(cell_);
    std::erase_if(all, [&](const Side& side) { return !star_.is_wall(side); });
    return all;
  }
  // The binary32 nearest to |n| mm².
  static Rational length(const Triangle& f) {
    const Rational square = squared(f.normal);
    return Rational(meshes::nearest_binary32(
        {0, false, Whole(numerator(square)) * Whole(denominator(square)), Whole(denominator(square)), 0}));
  }

  Direction in_plane() const {
    const std::vector<Side> sides = walls();
    if (sides.empty()) return {};
    const Triangle& f = star_.blocking(sides.front());
    return seen(f, star_.up(sides.front()), interpolated(f));
  }

  Direction on_line() const {
    const std::vector<Side> sides = walls();
    if (sides.size() != 2) return {};
    const Triangle &f = star_.blocking(sides[0]), &h = star_.blocking(sides[1]);
    const Vector up_1 = star_.up(sides[0]), up_2 = star_.up(sides[1]);
    const Vector N_1 = seen(f, up_1, interpolated(f)), N_2 = seen(h, up_2, interpolated(h));
    if (is_regular(f, h) && have_same_corners(f, h)) return N_1;
    const Vector n_1 = seen(f, up_1, f.normal), n_2 = seen(h, up_2, h.normal), turn = cross(n_1, n_2);
    if (is_zero(turn) || !dot(D_n_, turn).is_zero()) return {};
    const Rational alpha = dot(cross(D_n_, n_2), turn), beta = dot(cross(n_1, D_n_), turn);
    if (alpha < 0 || beta < 0) return {};
    return alpha * length(f) * N_1 + beta * length(h) * N_2;
  }

  // The corners that two triangles share, by their numbers in each.
  static std::vector<std::pair<std::size_t, std::size_t>> shared(const Triangle& f, const Triangle& h) {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (f.name[i] == h.name[j]) all.emplace_back(i, j);
    return all;
  }
  // Two triangles alone, whose common edge runs in opposite directions.
  bool is_regular(const Triangle& f, const Triangle& h) const {
    const auto common = shared(f, h);
    if (star_.triangles().size() != 2 || common.size() != 2) return false;
    const auto follows = [](std::size_t i, std::size_t j) { return (i + 1) % 3 == j; };
    return follows(common[0].first, common[1].first) != follows(common[0].second, common[1].second);
  }
  bool have_same_corners(const Triangle& f, const Triangle& h) const {
    return std::ranges::all_of(
        shared(f, h), [&](const auto& both) { return normals_[f.number][both.first] == normals_[h.number][both.second]; });
  }

  // Only if all triangles have one normal at this vertex, and nothing else passes.
  Direction at_vertex() const {
    Direction N;
    for (const Triangle* triangle : star_.triangles()) {
      const auto at = std::ranges::find(triangle->corner, r_);
      if (at == triangle->corner.end()) return {};
      const Vector its = corner(*triangle, static_cast<std::size_t>(at - triangle->corner.begin()));
      if (N && *N != its) return {};
      N = its;
    }
    if (!star_.is_one_part() || walls().empty()) return {};
    return std::get<1>(star_.name(cell_)) ? Vector(-*N) : *N;  // it says back
  }

  const Vector& r_;
  const Star& star_;
  Star::Cell cell_;
  Vector D_n_;
  const mesh::CornerNormals& normals_;
};

// whole + √square, or − √square.
meshes::RootSum sum_of(const Rational& whole, bool is_negative, const Rational& square) {
  const Whole under = lcm(Whole(denominator(whole)), Whole(denominator(square)));
  const auto times = [](const Rational& value, const Whole& by) { return Whole(numerator(Rational(value * Rational(by)))); };
  return {times(whole, under), is_negative, times(square, under * under), under, 0};
}

}  // namespace

State state_of(const mesh::GodObject& object) {
  if (object.place == mesh::Place::nowhere) return {};
  const auto& its = *std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.place == object.place && kind.meeting == object.meeting; });
  Place place{its.kind, its.of_foot, {}, {}};
  place.numbers.insert(place.numbers.end(), object.index.begin(), object.index.begin() + its.indices);
  place.numbers.insert(place.numbers.end(), object.further.begin(), object.further.begin() + its.further);
  place.numbers.insert(place.numbers.end(), object.parameter.begin(), object.parameter.begin() + its.parameters);
  if (its.kind == PlaceKind::free || its.kind == PlaceKind::foot) place.position = object.position;
  return {place, {object.cell[0], object.side == mesh::Side::back, object.cell[1]}, object.is_slipping};
}

mesh::GodObject object_of(const State& state) {
  mesh::GodObject object;
  if (!state.place) return object;
  const auto& its = *std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.kind == state.place->kind && kind.of_foot == state.place->of_foot; });
  object.place = its.place;
  object.meeting = its.meeting;
  object.position = state.place->position;
  auto number = state.place->numbers.begin();
  const auto take = [&](std::array<std::uint32_t, 2>& into, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) into[i] = static_cast<std::uint32_t>(*number++);
  };
  take(object.index, its.indices);
  take(object.further, its.further);
  take(object.parameter, its.parameters);
  object.is_slipping = state.is_slipping;
  if (its.kind == PlaceKind::free) return object;
  const auto& [triangle, is_behind, piece] = state.cell;
  object.side = is_behind ? mesh::Side::back : mesh::Side::front;
  object.cell = {static_cast<std::uint32_t>(triangle), static_cast<std::uint32_t>(piece)};
  return object;
}

std::unique_ptr<const meshes::Ticks> ticks_of(const MeshRendering& rendering) {
  return std::make_unique<SoupTicks>(rendering);
}

std::array<meshes::RootSum, 3> exact_force(const Rest& rest, float stiffness, const mesh::CornerNormals& normals) {
  const Direction N = normals.empty() ? std::nullopt : Shading(rest, normals).direction();
  const Rational K(stiffness);
  if (!N) return {sum_of(K * rest.D.x, false, 0), sum_of(K * rest.D.y, false, 0), sum_of(K * rest.D.z, false, 0)};
  const Rational size = K * K * squared(rest.D - rest.tangential) / squared(*N);
  const auto component = [&](const Rational& along, const Rational& part) {
    return sum_of(K * along, part < 0, size * part * part);
  };
  const Vector& t = rest.tangential;
  return {component(t.x, N->x), component(t.y, N->y), component(t.z, N->z)};
}

}  // namespace forceshade::reference::soups
