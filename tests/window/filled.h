// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A picture as pixels, without a display and without its text.

#include "window/canvas.h"

namespace forceshade::window {

// A pixel has the colour of the last item over its middle: no edge is smoothed.
Image filled(const Picture& picture, Size size);

}  // namespace forceshade::window
