// SPDX-License-Identifier: BSD-3-Clause
// The process of properties/conformance/doors/process_door.h: it loads the shared object that it is called with, and answers
// for it on standard input and output (docs/conformance-protocol.md) until goodbye. The object itself prints on standard error.

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cfenv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "forceshade.h"
#include "properties/conformance/doors/lines.h"
#include "properties/conformance/doors/process_door.h"
#include "rendering/control_words.h"

namespace forceshade::apps {
namespace {

constexpr const char* kEntry = "forceshade_renderer_entry";

// The object's fault, in words for the verdict.
struct ObjectFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reads or writes, whatever signals the object has set up.
template <class Call>
ssize_t undisturbed(Call call) {
  ssize_t size = 0;
  do size = call();
  while (size < 0 && errno == EINTR);
  return size;
}

// The standard streams as they were; what the object reads and prints itself is something else.
class Lines {
 public:
  Lines() : in_(kept(STDIN_FILENO)), out_(kept(STDOUT_FILENO)) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }

  std::optional<std::string> read() {
    std::size_t end = 0, looked_at = 0;
    while ((end = read_.find('\n', looked_at)) == std::string::npos) {
      looked_at = read_.size();
      std::array<char, 4096> more;
      const ssize_t size = undisturbed([&] { return ::read(in_, more.data(), more.size()); });
      if (size <= 0) return std::nullopt;
      read_.append(more.data(), static_cast<std::size_t>(size));
    }
    std::string line = read_.substr(0, end);
    read_.erase(0, end + 1);
    return line;
  }

  void write(std::string line) const {
    line += '\n';
    for (std::string_view rest = line; !rest.empty();) {
      const ssize_t size = undisturbed([&] { return ::write(out_, rest.data(), rest.size()); });
      if (size <= 0) return;  // the reader has gone
      rest.remove_prefix(static_cast<std::size_t>(size));
    }
  }

 private:
  // Processes that the object starts do not get it.
  static int kept(int stream) { return ::fcntl(stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); }

  int in_, out_;
  std::string read_;
};

const forceshade_renderer& table_of(const std::string& file) {
  void* const object = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) throw ObjectFailed(std::string("it cannot be loaded: ") + ::dlerror());
  auto* const entry = reinterpret_cast<forceshade_renderer_function*>(::dlsym(object, kEntry));
  if (entry == nullptr) throw ObjectFailed(std::string("it exports no function ") + kEntry);
  const forceshade_renderer* const table = entry();
  if (table == nullptr) throw ObjectFailed(std::string(kEntry) + "() returned no table");
  if (table->size < sizeof(forceshade_renderer))
    throw ObjectFailed("its table says that it has " + std::to_string(table->size) + " bytes; expected " +
                       std::to_string(sizeof(forceshade_renderer)) + " or more");
  const auto expect = [](bool is_there, const char* name) {
    if (!is_there) throw ObjectFailed(std::string("its table has no function ") + name);
  };
  expect(table->open != nullptr, "open");
  expect(table->answer != nullptr || table->answer_after != nullptr, "answer");
  expect(table->close != nullptr, "close");
  return *table;
}

// Before and after the answers that an object may write to lie as many that it may not.
constexpr std::ptrdiff_t kGuard = 64;
constexpr float kUnwritten = std::numeric_limits<float>::quiet_NaN();

bool is_unwritten(const Eigen::Vector3f& answer) {
  return std::ranges::all_of(
      answer, [](float number) { return std::bit_cast<std::uint32_t>(number) == std::bit_cast<std::uint32_t>(kUnwritten); });
}

class Renderer {
 public:
  Renderer(const forceshade_renderer& table, std::string_view scene) : table_(table) {
    const char* hello = nullptr;
    if (const std::int32_t code = table_.open(std::string(scene).c_str(), &state_, &hello); code != 0)
      throw ObjectFailed("its open() returned " + std::to_string(code) + (hello == nullptr ? "" : std::string(": ") + hello));
    if (hello == nullptr) throw ObjectFailed("its open() returned 0 and no hello");
    hello_ = hello;
    for (char& c : hello_)  // a line has no other end, and a text of JSON no line's end
      if (c == '\n' || c == '\r') c = ' ';
  }
  ~Renderer() noexcept(false) { table_.close(state_); }  // it may throw what it likes
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  const std::string& hello() const { return hello_; }

  // periods: of each position, or none, which stands for 1 each.
  std::vector<Eigen::Vector3f> answers(const std::vector<Eigen::Vector3f>& positions, std::vector<std::uint32_t> periods,
                                       bool is_reset) {
    const std::size_t count = positions.size();
    if (!periods.empty() && table_.answer_after == nullptr)
      throw ObjectFailed("it declares damping, and its table has no function answer_after");
    if (periods.empty()) periods.assign(count, 1);
    std::vector<Eigen::Vector3f> answers(kGuard + count + kGuard, Eigen::Vector3f::Constant(kUnwritten));
    const float* const asked = positions.data()->data();
    float* const answered = answers[kGuard].data();
    const std::int32_t code = table_.answer_after != nullptr
                                  ? table_.answer_after(state_, asked, periods.data(), answered, count, is_reset ? 1 : 0)
                                  : table_.answer(state_, asked, answered, count, is_reset ? 1 : 0);
    if (code != 0) throw ObjectFailed("its answer() returned " + std::to_string(code));
    const std::span<const Eigen::Vector3f> all(answers);
    for (const auto& guard : {all.first(kGuard), all.last(kGuard)})
      if (!std::ranges::all_of(guard, is_unwritten)) throw ObjectFailed("its answer() wrote outside of its answers");
    return {answers.begin() + kGuard, answers.end() - kGuard};
  }

 private:
  const forceshade_renderer& table_;
  void* state_ = nullptr;
  std::string hello_;
};

void answer(const std::string& file, Lines& lines) {
  const auto first = lines.read();
  if (!first) return;
  if (!first->starts_with(conformance::kScene)) throw ObjectFailed("its process expects the scene of conform 1 first");
  const std::string_view scene = std::string_view(*first).substr(conformance::kScene.size());
  Renderer renderer(table_of(file), scene.substr(0, scene.size() - 1));
  lines.write(renderer.hello());
  while (const auto line = lines.read()) {
    const bool is_reset = line->starts_with(conformance::kNewPath);
    std::vector<std::uint32_t> periods;
    const auto positions = conformance::numbers_in(*line, is_reset ? conformance::kNewPath : conformance::kPositions, &periods);
    if (!positions) return;  // goodbye
    lines.write(conformance::line_of(conformance::kAnswers, renderer.answers(*positions, std::move(periods), is_reset)));
  }
}

int exit_code_of(const std::string& file) {
  Lines lines;
  const auto fail = [&](const std::string& words) {
    lines.write(nlohmann::json{{"failure", words}}.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
    return 1;
  };
  try {
    answer(file, lines);
    return conformance::kObjectEndedWell;
  } catch (const ObjectFailed& failure) {
    return fail(failure.what());
  } catch (const std::exception& error) {
    return fail(std::string("it threw an exception: ") + error.what());
  } catch (...) {
    return fail("it threw something");
  }
}

}  // namespace
}  // namespace forceshade::apps

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const forceshade::ExactArithmetic with_all_bits;  // as the command has it
  const int code = forceshade::apps::exit_code_of(argv[1]);
  std::fesetenv(FE_DFL_ENV);  // the object may have left another one, with which libraries of this program do not end
  return code;
}
