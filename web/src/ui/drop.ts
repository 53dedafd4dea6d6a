/** Map files that are dropped anywhere on the page. */

import { byId } from "./dom";

export function listenToDrops(upload: (files: Iterable<File>) => Promise<void>): void {
  const sign = byId("drop");
  const holdsFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  document.addEventListener("dragover", (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    sign.hidden = false;
  });
  document.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) sign.hidden = true;
  });
  document.addEventListener("drop", (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    sign.hidden = true;
    void upload([...(event.dataTransfer?.files ?? [])]);
  });
}
