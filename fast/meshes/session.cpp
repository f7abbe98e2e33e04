// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/session.h"

#include "fast/numbers/arithmetic.h"

namespace forceshade::fast {
namespace {

// The point of a triangle that is nearest to `at`, about: only how good the bound below is depends on it.
Vector3<double> about_nearest(const std::array<Vector3<double>, 3>& corner, const Vector3<double>& at) noexcept {
  const auto along = [](const Vector3<double>& from, const Vector3<double>& by, double t) {
    return Vector3<double>{from.x + t * by.x, from.y + t * by.y, from.z + t * by.z};
  };
  const Vector3<double> e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], n = cross(e1, e2), w = at - corner[0];
  const double all = square(n), second = dot(cross(w, e2), n), third = dot(cross(e1, w), n);
  if (second >= 0 && third >= 0 && second + third <= all) return along(at, n, -dot(n, w) / all);
  Vector3<double> best = corner[0];
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3<double> e = corner[i == 2 ? 0 : i + 1] - corner[i];
    const double t = dot(at - corner[i], e) / square(e);
    const Vector3<double> point = along(corner[i], e, t < 0 ? 0 : t > 1 ? 1 : t);
    const double distance = square(at - point);
    if (distance < least) {
      least = distance;
      best = point;
    }
  }
  return best;
}

// A lower bound of the squared distance of a triangle, mm²: it lies beyond the plane through its corner that comes first along
// v, whatever v is. The roundings: a product of components up to 2^15 mm loses 2^-21 mm² at most, and the factor covers those
// of v's length and of the square.
double lower_bound_of_square(const Face& face, const Vector3<double>& at) noexcept {
  std::array<Vector3<double>, 3> corner;
  for (std::size_t i = 0; i < 3; ++i)
    corner[i] = {static_cast<double>(face.corner[i][0]), static_cast<double>(face.corner[i][1]),
                 static_cast<double>(face.corner[i][2])};
  const Vector3<double> v = about_nearest(corner, at) - at;
  const double length = std::sqrt(square(v));
  double first = HUGE_VAL;
  for (const Vector3<double>& c : corner) {
    const double along = dot(c - at, v);
    first = along < first ? along : first;
  }
  const double distance = first / length - 0x1p-30;
  return distance > 0 ? distance * distance * (1 - 0x1p-30) : 0;  // also where v is 0 or too long
}

}  // namespace

[[gnu::noinline]] void advance_filtered(const Mesh& mesh, Arrival& at, const std::array<float, 3>& p, float stiffness,
                                        mesh::Shading shading, mesh::Contact contact, Stage& stage, mesh::Tick& tick) noexcept {
  advance(mesh, at, p, stiffness, shading, FilteredStages{&stage}, tick, contact);
}

[[gnu::noinline]] mesh::Tick MeshSession::tick_on_mesh(const std::array<float, 3>& p) noexcept {
  mesh::Tick tick;
  advance_filtered(*mesh_, at_, p, stiffness_, shading_, contact_, stage_, tick);
  square_ = 0;  // a ball is of use only to a god-object that is in it
  if (at_.grid_point.place == mesh::Place::free)
    seek_ball();
  else
    is_seeking_ = false;
  tick.after = state();
  return tick;
}

[[gnu::noinline]] void MeshSession::look_ahead() noexcept {
  std::array<float, 3> position{};
  for (std::size_t i = 0; i < 3; ++i) position[i] = last_[i] + (last_[i] - before_[i]);
  if (!in_domain(position)) return;
  const std::array<float, 3> p = quantised(position);
  if (stays_free(p)) return;
  // The same code as the tick's, which has to be in the cache too.
  MeshSession ahead(*this);
  [[maybe_unused]] const volatile float kept = ahead.tick_on_mesh(p).force[0];
}

// Around where the god-object is when the search begins. It takes some ticks, so that each is short; meanwhile the ball before
// may still serve. A ball that the path leaves at once is not worth its search: then the next one waits.
[[gnu::noinline]] void MeshSession::seek_ball() noexcept {
  constexpr double kLeastSquare = 0x1p-4, kMostSquare = 0x1p30;  // mm²
  constexpr int kPause = 16, kBoxesOfATick = 4;
  const std::array<float, 3>& position = at_.grid_point.position;
  if (!is_seeking_) {
    if (ticks_until_ball_ > 0) {
      --ticks_until_ball_;
      return;
    }
    mesh_->tree().begin(search_,
                        {static_cast<double>(position[0]), static_cast<double>(position[1]), static_cast<double>(position[2])},
                        kMostSquare);
    is_seeking_ = true;
    renew_square_ = -1;
  }
  const std::array<double, 3>& centre = search_.point();
  const Vector3<double> at{centre[0], centre[1], centre[2]};
  mesh_->tree().advance(search_, kBoxesOfATick, [&](std::uint32_t f) { return lower_bound_of_square(mesh_->face(f), at); });
  if (!search_.is_done()) return;
  is_seeking_ = false;
  centre_ = centre;
  square_ = search_.square() * (1 - 0x1p-30);
  renew_square_ = square_ / 4;
  if (!is_in_ball(position)) square_ = 0;  // the god-object has left it during the search
  ticks_until_ball_ = square_ < kLeastSquare ? kPause : 0;
}

const char* MeshSession::arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
