// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Long computations that Ctrl-C ends.

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <memory>

namespace forceshade::python {

namespace py = pybind11;

// The result of work(stop), which a thread of its own does, while this one looks for signals: Python's own handlers run in
// no other. Called with the GIL; work() runs without it.
template <class Work>
auto interruptible(const Work& work) {
  std::atomic<bool> stop = false;
  std::unique_ptr<py::error_already_set> interrupted;
  {
    const py::gil_scoped_release released;
    auto done = std::async(std::launch::async, [&] { return work(stop); });
    while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
      const py::gil_scoped_acquire held;
      if (interrupted || PyErr_CheckSignals() == 0) continue;
      interrupted = std::make_unique<py::error_already_set>();
      stop = true;
    }
    if (!interrupted) return done.get();
    try {
      done.get();
    } catch (const std::exception&) {  // of what was stopped
    }
  }
  throw *interrupted;
}

}  // namespace forceshade::python
