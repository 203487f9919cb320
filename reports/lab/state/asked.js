// SPDX-License-Identifier: GPL-3.0-or-later
// What `hsr lab` has put into the page: bench/lab/lab.h.
import { ownOf } from "../scene/own.js";

const element = document.getElementById("asked");
const put = element ? JSON.parse(element.textContent) : null;
// Words of a name ("mesh:joint", "a.nii@palette=bone") mean nothing in one of a file.
const plain = (scene) => scene.split("/").pop().replace(/^mesh:|\.scene\.json$/g, "")
  .replace(/[^\w.-]+/g, "-");
const name = put?.file ? `${plain(put.scene)}.scene.json` : put?.scene;
const own = put?.file ? ownOf(name, new TextEncoder().encode(put.file)) : null;

// What the page opens with, as far as it was said.
export const asked = put ? { scene: name, own, camera: put.camera,
  ...put.algorithms.length ? { a: put.algorithms } : {} } : {};

// Pictures that hsr drew when it wrote the page, one for each algorithm, if the page opens
// with what they show. They are seen until the core has drawn.
export const firstPictures = [...document.querySelectorAll(".first-look img")];
export const FIRST_WORDS = document.querySelector(".first-look p")?.textContent;

// The page's own file, of that name; else null.
export const fileOfPage = (scene) => own && scene === name ? own : null;
