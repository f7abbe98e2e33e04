// SPDX-License-Identifier: BSD-3-Clause
import library from "./forceshade.js";

export const { load, ForceshadeError, LAWS } = library;
