// SPDX-License-Identifier: GPL-3.0-or-later
// What can be saved: the scene for hsr's command, and the picture.
import { offer } from "../../page/parts/save.js";
import { orderOf } from "../scene/mesh.js";
import { sceneFile } from "../scene/file.js";

export function savings(lab, source, pictures) {
  const { state } = lab;
  const plain = () => state.scene.replace(/[^\w.-]+/g, "-");

  async function scene() {
    const now = await source.current();
    const { views } = await now.info;
    const camera = pictures.camera();
    const mesh = await now.mesh();
    offer(`${plain()}.scene.json`, "application/json", sceneFile(mesh, plain(),
      state.camera ? [camera, ...views] : views));
    return `${orderOf(mesh).length} faces are saved. hsr opens the file as it is.`;
  }

  async function picture() {
    const canvas = document.querySelector("canvas.view, canvas.picture");
    if (!canvas) return "There is no picture here.";
    const blob = await new Promise((give) => canvas.toBlob(give));
    offer(`${plain()}.png`, "image/png", blob);
    return "";
  }

  return [["The scene (.scene.json)", "With the edits and the camera; hsr opens it",
    scene], ["The picture (.png)", "The first one, as it is shown", picture]];
}
