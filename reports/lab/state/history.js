// SPDX-License-Identifier: GPL-3.0-or-later
// Undo and redo of edits.

export function makeHistory(lab) {
  const { state } = lab;
  let undone = [];
  const known = () => lab.tell("history");
  return {
    add: (edit) => {
      undone = [];
      lab.set({ edits: [...state.edits, edit] });
      known();
    },
    // The edits were `before` until a drag changed them.
    done: () => {
      undone = [];
      known();
    },
    undo: () => {
      if (!state.edits.length) return;
      undone.push(state.edits.at(-1));
      lab.set({ edits: state.edits.slice(0, -1), chosen: null });
      known();
    },
    redo: () => {
      if (!undone.length) return;
      lab.set({ edits: [...state.edits, undone.pop()] });
      known();
    },
    forget: () => { undone = []; known(); },
    canUndo: () => state.edits.length > 0, canRedo: () => undone.length > 0,
  };
}
