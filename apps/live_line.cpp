// SPDX-License-Identifier: BSD-3-Clause
#include "apps/live_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "text/formatted.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

struct Piece {
  std::string text;
  int rank;  // the piece of the highest rank is left out first
};

std::string bar(double share) {
  constexpr std::size_t kWidth = 20;
  const auto filled = static_cast<std::size_t>(std::lround(kWidth * (share > 0 ? std::min(share, 1.0) : 0)));
  return '[' + std::string(filled, '#') + std::string(kWidth - filled, ' ') + ']';
}

}  // namespace

int room_for_a_line() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col - 1 : 79;
}

std::string live_line(const LiveLine& shown, int room) {
  std::vector<Piece> pieces{{formatted("%7.1f s", shown.seconds), 3},    {formatted("%6.0f Hz", shown.rate), 4},
                            {formatted("late %5.0f us", shown.late), 5}, {bar(shown.force / shown.full_force), 6},
                            {formatted("%6.3f N", shown.force), 0},      {formatted("%+9.3f mJ", shown.energy), 2}};
  if (!shown.limits.empty()) pieces.push_back({shown.limits, 1});
  const auto most = static_cast<std::size_t>(std::max(room, 0));
  while (pieces.size() > 1 && joined(pieces, "  ", &Piece::text).size() > most)
    pieces.erase(
        std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.rank < b.rank; }));
  return joined(pieces, "  ", &Piece::text).substr(0, most);
}

void draw_line(const std::string& text) {
  std::size_t end = 0;
  const auto is_inside_character = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };
  for (int room = room_for_a_line(); room > 0 && end < text.size(); --room) do
      ++end;
    while (end < text.size() && is_inside_character(end));
  std::fprintf(stderr, "\r%.*s\033[K", static_cast<int>(end), text.c_str());
}

}  // namespace forceshade::apps
