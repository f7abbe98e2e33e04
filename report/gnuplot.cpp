// SPDX-License-Identifier: BSD-3-Clause
#include "report/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "report/html.h"

extern char** environ;

namespace forceshade::properties {
namespace {

[[noreturn]] void fail(const std::string& what, int reason) {
  throw PlotError(what + ": " + std::generic_category().message(reason));
}

// An unnamed file in memory. Unlike a pipe it never fills up and never signals, so a child can be given all its input
// before it starts and be read after it has ended.
class Scratch {
 public:
  Scratch() : descriptor_(::memfd_create("gnuplot", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail("cannot make a buffer for gnuplot", errno);
  }
  ~Scratch() { ::close(descriptor_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  int descriptor() const { return descriptor_; }

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno != EINTR) fail("cannot write gnuplot's input", errno);
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    ::lseek(descriptor_, 0, SEEK_SET);
  }

  std::string read() const {
    std::string text;
    std::array<char, 1 << 12> bytes;
    for (;;) {
      const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(text.size()));
      if (got < 0 && errno != EINTR) fail("cannot read gnuplot's output", errno);
      if (got == 0) return text;
      if (got > 0) text.append(bytes.data(), static_cast<std::size_t>(got));
    }
  }

 private:
  int descriptor_;
};

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void redirect(int from, int to) { posix_spawn_file_actions_adddup2(&actions_, from, to); }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

// The output of gnuplot when given `commands` on standard input. It is opened by name, because gnuplot reads its own standard
// input byte by byte, and a picture has megabytes.
std::string run_gnuplot(std::string_view commands) {
  Scratch input, output, errors;
  input.write(commands);
  FileActions actions;
  actions.redirect(input.descriptor(), STDIN_FILENO);
  actions.redirect(output.descriptor(), STDOUT_FILENO);
  actions.redirect(errors.descriptor(), STDERR_FILENO);

  std::string name = "gnuplot", no_user_settings = "--default-settings", file = "/dev/stdin";
  std::array<char*, 4> arguments{name.data(), no_user_settings.data(), file.data(), nullptr};
  pid_t child = 0;
  const int reason = ::posix_spawnp(&child, name.c_str(), actions.get(), nullptr, arguments.data(), environ);
  if (reason == ENOENT) throw PlotError("gnuplot was not found: install the package gnuplot-nox");
  if (reason != 0) fail("cannot start gnuplot", reason);

  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail("cannot wait for gnuplot", errno);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                : "exit status " + std::to_string(WEXITSTATUS(status));
    throw PlotError("gnuplot failed (" + how + "): " + errors.read());
  }
  return output.read();
}

// gnuplot gives the same ids to every plot, and a browser would take all of them from the first one in the page.
std::string with_prefixed_ids(std::string_view svg, const std::string& prefix) {
  static constexpr std::array<std::string_view, 6> kBeforeId{" id='", " id=\"", "href='#", "href=\"#", "url(#", "url('#"};
  std::string result;
  result.reserve(svg.size() + svg.size() / 16);
  while (!svg.empty()) {
    std::size_t length = 1;
    bool is_id = false;
    for (const std::string_view before : kBeforeId) {
      if (!svg.starts_with(before)) continue;
      length = before.size();
      is_id = true;
    }
    result += svg.substr(0, length);
    if (is_id) result += prefix + '-';
    svg.remove_prefix(length);
  }
  return result;
}

// The plots' own titles would be shown as tooltips: "gnuplot_plot_1".
std::string without_titles(std::string_view svg) {
  std::string result;
  for (std::size_t start; (start = svg.find("<title>")) != std::string_view::npos;) {
    result += svg.substr(0, start);
    const std::size_t end = svg.find("</title>", start);
    if (end == std::string_view::npos) return result;
    svg.remove_prefix(end + std::string_view("</title>").size());
  }
  return result.append(svg);
}

}  // namespace

std::string svg_file(const Picture& picture) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg_plot(picture);
}

std::string png_file(const Picture& picture) {
  constexpr int kScale = 2;
  const auto& [width, height, id, description] = picture.frame;
  return run_gnuplot("set encoding utf8\nset minussign\nset terminal pngcairo size " + std::to_string(kScale * width) + ',' +
                     std::to_string(kScale * height) + " enhanced font 'sans-serif,12' fontscale " + std::to_string(kScale) +
                     " linewidth " + std::to_string(kScale) + " pointscale " + std::to_string(kScale) + " dashlength " +
                     std::to_string(kScale) + " background '#ffffff'\n" + picture.commands + '\n');
}

std::string svg_plot(const PlotFrame& frame, std::string_view commands) {
  std::string script = "set encoding utf8\nset minussign\nset terminal svg size " + std::to_string(frame.width) + ',' +
                       std::to_string(frame.height) + " dynamic enhanced font 'sans-serif,12' background '#ffffff'\n";
  script += commands;
  script += '\n';
  const std::string output = run_gnuplot(script);

  static constexpr std::string_view kOpening = "<svg";
  const std::size_t start = output.find(kOpening);
  if (start == std::string::npos) throw PlotError("gnuplot drew nothing");
  const std::string_view body = std::string_view(output).substr(start + kOpening.size());
  return "<svg role=\"img\" aria-label=\"" + escaped(frame.description) + '"' +
         with_prefixed_ids(without_titles(body), frame.id);
}

}  // namespace forceshade::properties
