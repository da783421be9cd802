/** Keys that come before the station can read them: this script is there before anything of the page is seen. */

globalThis.firstKeys = [];
addEventListener('keydown', (event) => globalThis.firstKeys?.push(event));
