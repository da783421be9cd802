/** Files beside the page's own: this module stays in the folder of the page, also where several became one file. */

/** The address of a file of the page, such as `stream_worker.js`. */
export const pageFile = (path) => new URL(path, import.meta.url);
