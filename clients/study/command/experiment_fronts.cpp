// SPDX-License-Identifier: BSD-3-Clause
#include "study/command/experiment_fronts.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

#include "apps/tell.h"
#include "study/experiments/language.h"

namespace forceshade::apps {
namespace {

using experiments::Action;
using experiments::Press;
using experiments::Screen;
using experiments::ScreenKind;

constexpr int kFrame = 16;  // ms

// Bytes of the character that begins with this byte.
std::size_t length_of_character(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0xC0U ? 1 : byte < 0xE0U ? 2 : byte < 0xF0U ? 3 : 4;
}

// Two screens with the same words are one.
std::string words_of_screen(const Screen& screen) {
  std::string words = "\n" + screen.title;
  if (screen.trial > 0)
    words += " (" + std::string(screen.is_practice ? "practice " : "") + std::to_string(screen.trial) + " of " +
             std::to_string(screen.trials) + ")";
  return words + "\n" + screen.text + "\n";
}

}  // namespace

std::optional<Press> press_of_character(ScreenKind kind, const std::string& character) {
  if (character == "\n" || character == "\r") return Press{Action::enter, ""};
  if (character == "\x7f" || character == "\b") return Press{Action::erase, ""};
  if (kind == ScreenKind::matching) {
    if (character == "j") return Press{Action::smaller, ""};
    if (character == "k") return Press{Action::bigger, ""};
    if (character == "l") return Press{Action::done, ""};
    return std::nullopt;
  }
  if (kind == ScreenKind::text || kind == ScreenKind::end) return std::nullopt;
  return Press{Action::type, character};
}

TerminalFront::TerminalFront() : is_terminal_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
  if (!is_terminal_) return;
  termios by_key = before_;
  by_key.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  by_key.c_cc[VMIN] = 1;
  by_key.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &by_key);
}

TerminalFront::~TerminalFront() {
  if (is_terminal_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
}

bool TerminalFront::show(const Screen& screen, const std::optional<device::Sample>&, const experiments::Scene&) {
  kind_ = screen.kind;
  if (const std::string words = words_of_screen(screen); words != shown_) {
    std::printf("%s%s", is_terminal_ ? "\r\033[K" : "", words.c_str());
    std::fflush(stdout);
    shown_ = words;
  }
  pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (!typed_.empty() || ::poll(&input, 1, kFrame) <= 0) return true;
  std::array<char, 256> bytes;
  const ssize_t got = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (got > 0)
    typed_.append(bytes.data(), static_cast<std::size_t>(got));
  else
    is_closed_ = got == 0 || (errno != EINTR && errno != EAGAIN);
  return !is_closed_;
}

// One at a time: what a key means follows from the screen that the one before has led to.
std::vector<Press> TerminalFront::presses() {
  constexpr char kEndOfInput = '\x04';
  if (typed_.empty()) return {};
  const std::size_t length = std::min(length_of_character(typed_[0]), typed_.size());
  const std::string character = typed_.substr(0, length);
  typed_.erase(0, length);
  if (is_terminal_ && character[0] == kEndOfInput) is_closed_ = true;
  const auto press = press_of_character(kind_, character);
  return press ? std::vector<Press>{*press} : std::vector<Press>{};
}

WindowFront::WindowFront(const window::WindowSettings& settings, apparatus::Bumps& bumps, device::Steering* steering,
                         const Eigen::Vector3f& origin)
    : bumps_(bumps),
      steering_(steering),
      origin_(origin.cast<double>()),
      window_(settings, experiments::read_language(bumps.protocol().language).labels) {
  if (!window_.note().empty()) tell(window_.note());
}

window::Scene WindowFront::seen(const std::optional<device::Sample>& latest, const experiments::Scene& felt) {
  constexpr double kMil = experiments::kMillimetresPerMil;
  const experiments::Protocol& protocol = bumps_.protocol();
  window::Scene seen;
  seen.shows_tip_alone = steering_ != nullptr;
  seen.width = protocol.width * kMil;
  if (protocol.spacing > 0) seen.separation = protocol.spacing * kMil;
  if (!latest) return seen;
  const auto& [x, y, z] = latest->position;
  const Eigen::Vector3d tip = Eigen::Vector3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) - origin_;
  seen.tip = window::Position{tip.x(), tip.y(), tip.z()};
  const auto& bump = felt.right && tip.x() >= 0 ? felt.right : felt.left;
  if (bump) seen.felt_height = bumps_.height(*bump, tip.x() - bump->position * kMil);
  return seen;
}

bool WindowFront::show(const Screen& screen, const std::optional<device::Sample>& latest, const experiments::Scene& felt) {
  const bool is_open = window_.draw(screen, seen(latest, felt));
  if (const auto mouse = window_.mouse(); mouse && steering_ != nullptr)
    steering_->aim(origin_ + Eigen::Vector3d(mouse->x, mouse->y, mouse->z));
  return is_open;
}

}  // namespace forceshade::apps
