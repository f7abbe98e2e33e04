// SPDX-License-Identifier: BSD-3-Clause
// A renderer that is written in Python, held against the exact definition: the door of callables.

#include "properties/conformance/conform.h"

#include <atomic>
#include <string>
#include <utility>

#include "bindings/python/arrays.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/subject.h"
#include "files/json_line.h"
#include "files/printable.h"
#include "forceshade/certificate.h"
#include "properties/conformance/judgement_text.h"

namespace forceshade::python {
namespace {

using Json = nlohmann::ordered_json;

// The words of an error. Asking for them may raise another error, and they may hold characters that UTF-8 does not have.
std::string words_of(const py::error_already_set& error) {
  try {
    return py::bytes(py::str(error.value()).attr("encode")("utf-8", "backslashreplace"));
  } catch (const py::error_already_set&) {
    return "(it does not say why)";
  }
}

// Turns an error that Python raises in the call into words, while the GIL is held.
template <class Call>
auto words_for_errors(const Call& call) {
  const py::gil_scoped_acquire held;
  try {
    return call();
  } catch (const py::error_already_set& error) {
    throw files::ProcessFailed("the renderer raised " + error.type().attr("__name__").cast<std::string>() + ": " +
                               files::printable(words_of(error)));
  }
}

// A function of Python's, which is given up while the GIL is held.
struct Function {
  py::object its;

  Function() = default;
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;
  ~Function() {
    const py::gil_scoped_acquire held;
    its = py::object();
  }
};

// open_it(scene) -> (hello, answers); answers(positions, is_reset, periods) -> float32 array (n, 3), of the bytes of arrays of
// float32 and of uint32, the latter empty where each is 1.
class PythonRenderer final : public conformance::RendererUnderTest {
 public:
  PythonRenderer(const py::object& open_it, const Json& scene) {
    const std::string hello = words_for_errors([&] {
      const py::tuple opened = open_it(scene.dump());
      answers_.its = opened[1];
      return opened[0].cast<std::string>();
    });
    hello_ = conformance::hello_of(files::object_in(hello, "renderer"), scene);
  }

  const conformance::Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                       std::span<const std::uint32_t> periods) override {
    return words_for_errors([&] {
      const auto bytes_of = [](const auto& its) {
        return py::bytearray(reinterpret_cast<const char*>(its.data()), its.size_bytes());
      };
      const py::buffer answered = answers_.its(bytes_of(positions), is_reset, bytes_of(periods));
      const py::buffer_info given = buffer_of<float>(answered);
      if (given.shape != std::vector<py::ssize_t>{static_cast<py::ssize_t>(positions.size()), 3})
        throw py::value_error("expected an answer to each position");
      std::vector<Eigen::Vector3f> answers(positions.size());
      for (std::size_t i = 0; i < answers.size(); ++i)
        answers[i] = {at<float>(given, i, 0), at<float>(given, i, 1), at<float>(given, i, 2)};
      return answers;
    });
  }

  void say_goodbye() override {}

 private:
  conformance::Hello hello_;
  Function answers_;
};

// True if all held; the words; and the JSON.
py::tuple conformance_of(const Subject& subject, const py::object& open_it, std::uint64_t points, std::uint64_t seed,
                         const std::string& tolerance_text) {
  expect_arithmetic();
  const auto tolerance = conformance::tolerance_of(tolerance_text);
  if (!tolerance)
    throw py::value_error("tolerance: expected \"4 ulp\", \"1e-6 N\" or \"0.1 %\", got \"" + tolerance_text + '"');
  const conformance::ConformOptions options{.points = points, .seed = seed, .tolerance = *tolerance};
  const conformance::Circumstances circumstances{options, properties::current_build().version, ""};
  const auto found = interruptible([&](const std::atomic<bool>& stop) {
    return conformance::conform(
        subject.description, [&](const Json& scene) { return std::make_unique<PythonRenderer>(open_it, scene); },
        circumstances.options, Monitor([](double) {}, stop));
  });
  return py::make_tuple(found.held(), found.is_applicable(), conformance::words_of(found, *tolerance),
                        conformance::text_of(conformance::json_of(found, circumstances)));
}

}  // namespace

void add_conform(py::module_& module) {
  module.def("conform", &conformance_of);
}

}  // namespace forceshade::python
