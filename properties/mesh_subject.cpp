// SPDX-License-Identifier: BSD-3-Clause
#include "properties/mesh_subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "properties/binary32.h"
#include "properties/built_or_throw.h"
#include "properties/generators.h"
#include "properties/mesh_energy.h"
#include "properties/mesh_path.h"
#include "properties/mesh_properties.h"
#include "properties/spread.h"
#include "properties/worst_tick.h"
#include "rendering/mesh_rendering.h"
#include "text/formatted.h"

namespace forceshade::properties {
namespace {

MeshPosition position_of(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

class ReferenceOfMesh final : public ReferenceSession {
 public:
  explicit ReferenceOfMesh(reference::GodObject god_object) : session_(std::move(god_object)) {}

  reference::Rounded step(const Eigen::Vector3f& position) override {
    const mesh::Tick tick = session_.step(position_of(position));
    reference::Rounded answer;
    answer.force = {tick.force[0], tick.force[1], tick.force[2]};
    answer.method = reference::Method::exact;
    answer.status = tick.status;
    answer.damping = tick.damping;
    return answer;
  }
  std::optional<std::array<std::string, 3>> decimal(unsigned digits) const override {
    const reference::DecimalMapForce force = session_.decimal(digits);
    return std::array{force.x, force.y, force.z};
  }

 private:
  reference::GodObjectSession session_;
};

// A path over the mesh, with positions of the kinds by which every certificate counts its points.
class MeshPositions final : public Positions, private Draws {
 public:
  MeshPositions(std::shared_ptr<const MeshRendering> rendering, std::uint64_t seed)
      : Draws(seed), path_(rendering->mesh(), seed) {}

  Aimed next() override {
    const MeshPosition p = path_.next();
    Aimed aimed{{p[0], p[1], p[2]}, aim_of(path_.kind())};
    switch (bits() % 64) {
      case 0: return with(aimed, Aim::quantum, tiny());
      case 1: return with(aimed, Aim::tie, any_binade());
      default: return aimed;
    }
  }

 private:
  Aimed with(Aimed aimed, Aim aim, float coordinate) {
    aimed.position[static_cast<Eigen::Index>(bits() % 3)] = coordinate;
    return {aimed.position, aim};
  }

  static Aim aim_of(PathKind kind) {
    switch (kind) {
      case PathKind::walk:
      case PathKind::stroke:
      case PathKind::jump: return Aim::volume;
      case PathKind::press:
      case PathKind::graze:
      case PathKind::on_surface: return Aim::surface;
      case PathKind::beside_vertex: return Aim::facet_line;
      case PathKind::axis_parallel: return Aim::axis;
      case PathKind::few_bits: return Aim::few_bits;
      case PathKind::domain_end: return Aim::domain_end;
      case PathKind::invalid: return Aim::any_bits;
    }
    return Aim::volume;
  }

  MeshPath path_;
};

constexpr int kLongest = 80;  // positions of a path that is drawn

// Short ones more often than long ones.
Generator<std::vector<MeshPosition>> path_on(const MeshRendering& rendering) {
  const auto draw = [&rendering](std::uint64_t seed) {
    Draws draws(seed);
    MeshPath source(rendering.mesh(), draws.bits());
    const double longer = (kLongest - 2) * draws.uniform(0, 1) * draws.uniform(0, 1);
    std::vector<MeshPosition> path(2 + static_cast<std::size_t>(longer));
    for (MeshPosition& position : path) position = source.next();
    return path;
  };
  return {draw, [](const std::vector<MeshPosition>& path) { return shorter(path, 1); }};
}

std::vector<Ticked> ticked(fast::TickSession& session, const std::vector<MeshPosition>& path) {
  std::vector<Ticked> ticks;
  for (const MeshPosition& position : path) ticks.push_back({position, session.tick(position)});
  return ticks;
}

bool is_valid(const MeshPosition& p) {
  return properties::is_valid(Eigen::Vector3f(p[0], p[1], p[2]));
}

std::string words_of(const mesh::Tick& tick) {
  const mesh::GodObject& state = tick.after;
  std::string words = std::string(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)]) + ", " +
                      std::string(mesh::kPlaceNames[static_cast<std::size_t>(state.place)]);
  for (const std::uint32_t number : {state.index[0], state.index[1], state.parameter[0], state.parameter[1]})
    words += ' ' + std::to_string(number);
  words += ' ' + std::string(mesh::kSideNames[static_cast<std::size_t>(state.side)]) + ", " + std::to_string(tick.moves) +
           " moves, (" + show(tick.force[0]) + ", " + show(tick.force[1]) + ", " + show(tick.force[2]) + ") N";
  return words;
}

bool is_same(const mesh::Tick& a, const mesh::Tick& b) {
  return a.status == b.status && a.moves == b.moves && a.after == b.after &&
         std::equal(a.force.begin(), a.force.end(), b.force.begin(), same_bits);
}

Violation differs(std::size_t i, const MeshPosition& p, const mesh::Tick& got, const mesh::Tick& expected) {
  if (is_same(got, expected)) return std::nullopt;
  return "tick " + std::to_string(i) + " at (" + show(p[0]) + ", " + show(p[1]) + ", " + show(p[2]) + ") mm: " + words_of(got) +
         "; expected " + words_of(expected);
}

}  // namespace

OpenTicks fast_god_object(const MeshRendering& rendering) {
  return [god_object = built_or_throw(fast::GodObject::build(rendering))](float stiffness) {
    return built_or_throw(god_object.with_stiffness(stiffness)).open();
  };
}

MeshSubject::MeshSubject(const std::string& name, MeshRendering rendering, OpenTicks open, bool is_rendered_by_library)
    : KindOfLibrary(is_rendered_by_library),
      mesh_(std::make_shared<const MeshRendering>(std::move(rendering))),
      stiffness_(mesh_->stiffness),
      open_(std::move(open)),
      rendering_{identity_of(name, *mesh_), {[its = open_, K = stiffness_] { return its(K); }}} {
  if (const auto error = first_error_of_any(*mesh_)) throw std::invalid_argument(error->message());
}

const reference::GodObject& MeshSubject::reference() const {
  std::call_once(is_built_, [this] { reference_ = built_or_throw(reference::GodObject::build(*mesh_)); });
  return *reference_;
}

std::vector<std::string> MeshSubject::parts() const {
  std::vector<std::string> words{std::to_string(mesh_->mesh().triangles.size()) + " triangles, " +
                                 std::to_string(mesh_->mesh().vertices.size()) + " vertices"};
  if (mesh_->shading == mesh::Shading::vertex_scheme) {
    double turn = 0;
    for (std::uint32_t i = 0; i < mesh_->mesh().triangles.size(); ++i) turn = std::max(turn, largest_turn(*mesh_, i));
    words.push_back(std::string("at a rest inside a triangle") +
                    (mesh_->checked.is_regular() ? "" : ", where no other plane's is,") +
                    std::string(" the shading gives at most ") + formatted("%.4f", std::ceil(turn * 1e4) / 1e4) +
                    " mJ more for each mm of path and N of force");
  }
  words.push_back(words_of(worst_tick(*mesh_)));
  for (const std::string& part : forceshade::words_of(mesh_->texture.map)) words.push_back("texture, " + part);
  return words;
}

std::unique_ptr<ReferenceSession> MeshSubject::open_reference() const {
  return std::make_unique<ReferenceOfMesh>(reference());
}

std::unique_ptr<Positions> MeshSubject::positions(std::uint64_t seed) const {
  return std::make_unique<MeshPositions>(mesh_, seed);
}

std::vector<Eigen::Vector3f> MeshSubject::draw_path(Chooser& choose) const {
  std::vector<Eigen::Vector3f> path;
  for (const MeshPosition& p : choose(path_on(*mesh_))) path.emplace_back(p[0], p[1], p[2]);
  return path;
}

Violation MeshSubject::check_continuity(Chooser& choose) const {
  const auto path = choose(path_on(*mesh_));
  const auto session = open_(stiffness_), beside = open_(stiffness_);
  const auto axis = static_cast<std::size_t>(choose(integers(0, 2)));
  const float towards = choose(integers(0, 1)) == 0 ? INFINITY : -INFINITY;
  mesh::GodObject state;
  for (const MeshPosition& position : path) {
    const Ticked here{position, session->tick(position)};
    MeshPosition near = position;
    near[axis] = std::nextafter(near[axis], towards);
    if (is_valid(position) && is_valid(near) && state.place != mesh::Place::nowhere) {
      beside->resume(state);
      if (auto violation = force_follows_the_spring(*mesh_, here, {near, beside->tick(near)})) return violation;
    }
    state = here.tick.after;
  }
  return std::nullopt;
}

Violation MeshSubject::check_unit_normals(Chooser& choose) const {
  const auto session = open_(stiffness_);
  for (const Ticked& one : ticked(*session, choose(path_on(*mesh_))))
    if (auto violation = force_is_as_long_as_the_spring(*mesh_, one)) return violation;
  return std::nullopt;
}

Violation MeshSubject::check_passivity(Chooser& choose) const {
  auto path = choose(path_on(*mesh_));
  std::erase_if(path, [](const MeshPosition& position) { return !is_valid(position); });
  const auto session = open_(stiffness_);
  return spring_gives_no_energy(*mesh_, ticked(*session, path));
}

std::vector<FurtherProperty> MeshSubject::further_properties() const {
  const auto states = [this](Chooser& choose) -> Violation {
    const auto path = choose(path_on(*mesh_));
    const auto split = static_cast<std::size_t>(choose(integers(0, static_cast<int>(path.size()) - 1)));
    auto session = open_(stiffness_);
    mesh::GodObject state;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i == split) {
        session = open_(stiffness_);
        session->resume(state);
      }
      const mesh::Tick expected = reference().step(state, path[i]);
      if (auto violation = differs(i, path[i], session->tick(path[i]), expected)) return violation;
      state = expected.after;
    }
    return std::nullopt;
  };
  const auto repeats = [this](Chooser& choose) -> Violation {
    const auto path = choose(path_on(*mesh_));
    const auto session = open_(stiffness_);
    for (std::size_t i = 0; i < path.size(); ++i) {
      mesh::Tick first = session->tick(path[i]);
      if (first.status == Status::unfinished) continue;
      mesh::Tick again = session->tick(path[i]);
      first.moves = again.moves = 0;
      if (auto violation = differs(i, path[i], again, first)) return "repeated, " + *violation;
    }
    return std::nullopt;
  };
  // A sub-goal depends on where the god-object is, which goes on.
  if (mesh_->contact == mesh::Contact::sub_goal) return {{"states", states}};
  return {{"states", states}, {"repeats", repeats}};
}

Expected MeshSubject::expected() const {
  std::vector<std::string> words{"where the god-object leaves a rim, a wide edge or a vertex"};
  if (!mesh_->checked.is_regular()) words.emplace_back("where it leaves a line or a point in which triangles meet");
  if (mesh_->shading != mesh::Shading::none) words.emplace_back("where the shading is given up");
  if (mesh_->contact == mesh::Contact::sub_goal) words.emplace_back("where the sub-goal leaves the surface");
  if (mesh_->shading == mesh::Shading::texture_scheme) {
    words.emplace_back("where the texture's slope jumps, and between the steps of its rounded coordinates");
    words.emplace_back("on flat and wide edges that separate the texture, its seams");
  }
  return {words, true, false};
}

DrawnSubject MeshSubject::with_drawn_parameters(std::uint64_t seed) const {
  MeshRendering rendering = *mesh_;
  rendering.stiffness = ParameterSource(seed).next().stiffness;
  const std::string words = "K = " + show(rendering.stiffness) + " N/mm: ";
  return {std::make_unique<MeshSubject>(identity().name, std::move(rendering), open_, is_rendered_by_library()), words};
}

std::unique_ptr<Subject> mesh_subject(const std::string& name, const MeshRendering& rendering) {
  return std::make_unique<MeshSubject>(name, rendering);
}

std::unique_ptr<Subject> mesh_subject(const std::string& name, const MeshRendering& rendering, OpenTicks open) {
  return std::make_unique<MeshSubject>(name, rendering, std::move(open));
}

}  // namespace forceshade::properties
