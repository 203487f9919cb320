// SPDX-License-Identifier: GPL-3.0-or-later
// A script of its own, which comes before that of the page: the core is unpacked,
// compiled and asked what it has while the browser reads the rest.
import { openCore } from "./connect.js";

globalThis.openedCore = openCore();
globalThis.openedCore.catch(() => {}); // the page, which waits for it, says so
