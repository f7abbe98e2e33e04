// SPDX-License-Identifier: BSD-3-Clause
// Sessions: one path of the hand each, for one thread at a time.

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "bindings/c/batch.h"
#include "bindings/c/session.h"
#include "bindings/c/states.h"
#include "bindings/python/arrays.h"
#include "bindings/python/damping.h"
#include "bindings/python/entered.h"
#include "bindings/python/subject.h"
#include "forceshade/error.h"

namespace forceshade::python {
namespace {

struct Session {
  static constexpr const char* kBusy =
      "another thread is in this session; expected one thread at a time, or a session for each";

  Session(std::shared_ptr<const Subject> of, const std::optional<DampingNumbers>& numbers)
      : subject(std::move(of)), path(*subject), damping(damping_of(numbers)) {}

  fast::Evaluation step(const Eigen::Vector3f& position, std::uint32_t periods) noexcept {
    fast::Evaluation answer = path.step(position);
    if (damping) answer = damping->tick(position, periods, answer);
    status = c::status_of(answer.status);
    return answer;
  }

  std::shared_ptr<const Subject> subject;
  c::Session path;
  std::optional<fast::Damping> damping;
  forceshade_status status = FORCESHADE_FREE;  // of the last step
  std::atomic<bool> is_busy = false;
};

PyObject* step(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* names) {
  float position[3];
  if (!read_position(arguments, count, names, position)) return nullptr;
  auto* const session = object_of<Session>(self);
  if (session == nullptr) {
    PyErr_SetString(PyExc_TypeError, "step() needs a session whose __init__ has run");
    return nullptr;
  }
  const Entered entered(*session);
  if (!entered) {
    PyErr_SetString(py::module_::import("forceshade._forceshade").attr("Error").ptr(), Session::kBusy);
    return nullptr;
  }
  return tuple_of(session->step(*c::as_vectors(position), 1).force.data());
}

PyMethodDef step_method{
    "step", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&step)), METH_FASTCALL | METH_KEYWORDS,
    "step($self, x, y, z, *, rounding=None)\n--\n\n"
    "The force (N) at the next position of the path (mm), as a tuple of three floats.\n\n"
    "x, y, z: numbers. One that binary32 does not hold is rounded to the nearest, with a RoundingWarning unless "
    "rounding=\"nearest\".\n\n"
    "`status` then says what the position was. Raises forceshade.Error while another thread is in this session.\n"};

std::size_t steps(Session& session, const py::buffer& positions, const py::buffer& forces,
                  const std::optional<py::buffer>& statuses, const std::optional<py::buffer>& periods) {
  const Entered entered(session);
  entered.or_throw();
  expect_arithmetic();
  const Batches batches(positions, forces, statuses);
  Periods all(periods, batches.size());
  std::size_t invalid = 0;
  batches.for_each_part(4096, [&](const forceshade_batch& batch) {
    const std::uint32_t* const its = all.next(batch.count);
    invalid += c::answer_each(batch, [&](const Eigen::Vector3f& position, std::size_t i) noexcept {
      return session.step(position, its == nullptr ? 1 : its[i]);
    });
  });
  return invalid;
}

using Pair = std::array<std::uint32_t, 2>;
using State = std::tuple<int, int, bool, std::array<float, 3>, Pair, Pair, int, Pair, Pair>;

// The members that c::is_state() and c::god_object_of() look at.
struct Numbers {
  std::uint8_t place, side, slipping;
  float position[3];
  std::uint32_t index[2], parameter[2];
  std::uint8_t meeting;
  std::uint32_t further[2], cell[2];
};

State state_of(Session& session) {
  const Entered entered(session);
  entered.or_throw();
  const mesh::GodObject& its = session.path.state();
  return {static_cast<int>(its.place),
          static_cast<int>(its.side),
          its.is_slipping,
          its.position,
          its.index,
          its.parameter,
          static_cast<int>(its.meeting),
          its.further,
          its.cell};
}

void resume(Session& session, const State& from) {
  const Entered entered(session);
  entered.or_throw();
  const auto& [place, side, is_slipping, position, index, parameter, meeting, further, cell] = from;
  const auto byte = [](int number) { return static_cast<std::uint8_t>(std::clamp(number, 0, 255)); };
  const Numbers numbers{byte(place),          byte(side),
                        is_slipping,          {position[0], position[1], position[2]},
                        {index[0], index[1]}, {parameter[0], parameter[1]},
                        byte(meeting),        {further[0], further[1]},
                        {cell[0], cell[1]}};
  if (std::min({place, side, meeting}) < 0 || !c::is_state(numbers))
    throw py::value_error("state: expected one that a session gave");
  if (!session.path.remembers() && place != 0)
    throw Error("the state is that of a mesh's session; a law or a height map remembers nothing");
  session.path.resume(c::god_object_of(numbers));
  session.status = FORCESHADE_FREE;
}

}  // namespace

void add_sessions(py::module_& module) {
  py::class_<Session> session(module, "Session");
  session.def(py::init([](std::shared_ptr<Subject> subject, const std::optional<DampingNumbers>& damping) {
                expect_arithmetic();
                return std::make_unique<Session>(std::move(subject), damping);
              }),
              py::arg(), py::arg() = py::none());
  add_method(session, step_method);
  session.def("_steps", &steps, py::arg(), py::arg(), py::arg() = py::none(), py::arg() = py::none());
  add_damping_state(session);
  session.def_property_readonly("_status", [](const Session& its) { return static_cast<int>(its.status); });
  session.def("_state", &state_of);
  session.def("_resume", &resume);
}

}  // namespace forceshade::python
