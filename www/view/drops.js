/** Dropping files anywhere opens them. */

/** @param {{ onFiles: (files: File[]) => void, onDragging: (is: boolean) => void }} callbacks */
export function acceptDrops({ onFiles, onDragging }) {
  let depth = 0;
  const carriesFiles = (/** @type {DragEvent} */ event) =>
    event.dataTransfer?.types.includes('Files') ?? false;
  // Leaving a child of the page is not leaving the page.
  const count = (/** @type {number} */ next) => {
    const was = depth > 0;
    depth = Math.max(next, 0);
    if (depth > 0 !== was) onDragging(depth > 0);
  };
  addEventListener('dragenter', (event) => carriesFiles(event) && count(depth + 1));
  addEventListener('dragleave', (event) => carriesFiles(event) && count(depth - 1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    count(0);
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) onFiles(files);
  });
}
