/** Reads a QR code with jsQR, which others wrote. */

import { createRequire } from 'node:module';
import path from 'node:path';

const jsqr = createRequire(path.join(process.env.WEB_TEST_MODULES, 'package.json'))('jsqr');

const PIXELS = 4;
const QUIET = 4;

/** What a camera sees of rows of modules, and what is read from it: {data, version}, or null. */
export function read(modules) {
  const width = (modules.length + 2 * QUIET) * PIXELS;
  const pixels = new Uint8ClampedArray(width * width * 4).fill(255);
  for (let y = 0; y < width; ++y) {
    for (let x = 0; x < width; ++x) {
      const dark = modules[Math.floor(y / PIXELS) - QUIET]?.[Math.floor(x / PIXELS) - QUIET];
      if (dark) pixels.fill(0, 4 * (y * width + x), 4 * (y * width + x) + 3);
    }
  }
  return jsqr(pixels, width, width);
}

/** The modules of a drawing: its path has a square for each that is dark. */
export function modulesOf(path, size) {
  const modules = Array.from({ length: size - 2 * QUIET }, () => Array(size - 2 * QUIET).fill(false));
  for (const [, x, y] of path.matchAll(/M(\d+) (\d+)h1v1h-1z/g)) modules[y - QUIET][x - QUIET] = true;
  return modules;
}
