/** QR codes (ISO/IEC 18004) of short texts: bytes, error correction M, versions 1 to 10. */

import { s } from '../dom.js';

/** By version: error correction words of a block, then [blocks, data words of each]. */
const BLOCKS = [null, [10, [1, 16]], [16, [1, 28]], [26, [1, 44]], [18, [2, 32]], [24, [2, 43]], [16, [4, 27]], [18, [4, 31]],
  [22, [2, 38], [2, 39]], [22, [3, 36], [2, 37]], [26, [4, 43], [1, 44]]];
const ALIGNMENTS = [[], [], [6, 18], [6, 22], [6, 26], [6, 30], [6, 34], [6, 22, 38], [6, 24, 42], [6, 26, 46], [6, 28, 50]];
const LEVEL_M = 0;
const MASKS = [(y, x) => (y + x) % 2, (y) => y % 2, (y, x) => x % 3, (y, x) => (y + x) % 3, (y, x) => (Math.floor(y / 2) + Math.floor(x / 3)) % 2,
  (y, x) => (y * x) % 2 + (y * x) % 3, (y, x) => ((y * x) % 2 + (y * x) % 3) % 2, (y, x) => ((y + x) % 2 + (y * x) % 3) % 2];
const QUIET = 4;

/** A drawing of the code with its quiet zone; null for a text that is too long. */
export function qrCode(text, label) {
  const modules = qrModules(text);
  if (!modules) return null;
  const size = modules.length + 2 * QUIET;
  const path = modules.flatMap((row, y) => row.map((dark, x) => (dark ? `M${x + QUIET} ${y + QUIET}h1v1h-1z` : ''))).join('');
  return s('svg.qr', { viewBox: `0 0 ${size} ${size}`, role: 'img', 'aria-label': label, 'shape-rendering': 'crispEdges' }, s('path', { d: path }));
}

/** Rows of modules, true is dark; null for a text that is too long. */
export function qrModules(text) {
  const bytes = new TextEncoder().encode(text);
  const version = BLOCKS.findIndex((blocks, v) => blocks && bytes.length <= dataWords(blocks) - (v < 10 ? 2 : 3));
  if (version < 0) return null;
  const words = interleaved(dataOf(bytes, version), BLOCKS[version]);
  const tried = MASKS.map((_, mask) => drawn(version, words, mask));
  const penalties = tried.map(penalty);
  return tried[penalties.indexOf(Math.min(...penalties))];
}

const dataWords = ([, ...groups]) => groups.reduce((sum, [count, words]) => sum + count * words, 0);

/** Mode, length, bytes, and what fills up the rest. */
function dataOf(bytes, version) {
  const bits = [];
  const put = (value, count) => { for (let i = count - 1; i >= 0; --i) bits.push(value >> i & 1); };
  const most = dataWords(BLOCKS[version]) * 8;
  put(4, 4);
  put(bytes.length, version < 10 ? 8 : 16);
  for (const byte of bytes) put(byte, 8);
  put(0, Math.min(4, most - bits.length));
  put(0, -bits.length & 7);
  for (let i = 0; bits.length < most; ++i) put(i % 2 ? 0x11 : 0xEC, 8);
  return Array.from({ length: most / 8 }, (_, i) => bits.slice(8 * i, 8 * i + 8).reduce((word, bit) => 2 * word + bit, 0));
}

/** The words of all blocks in turn, data first. */
function interleaved(data, [corrections, ...groups]) {
  let from = 0;
  const blocks = groups.flatMap(([count, words]) => Array.from({ length: count }, () => data.slice(from, from += words)));
  const checks = blocks.map((block) => remainder(block, corrections));
  const inTurn = (lists) => Array.from({ length: Math.max(...lists.map((list) => list.length)) }, (_, i) => lists.filter((list) => i < list.length).map((list) => list[i])).flat();
  return [...inTurn(blocks), ...inTurn(checks)];
}

/** A product in the field of 256 elements with x^8 + x^4 + x^3 + x^2 + 1. */
function times(one, other) {
  let product = 0;
  for (let i = 7; i >= 0; --i) product = (product << 1) ^ (product >> 7) * 0x11D ^ (other >> i & 1) * one;
  return product;
}

/** The Reed-Solomon words of a block. */
function remainder(block, count) {
  let generator = [1];
  for (let i = 0, root = 1; i < count; ++i, root = times(root, 2)) {
    generator = [...generator, 0].map((factor, at) => factor ^ (at ? times(generator[at - 1], root) : 0));
  }
  const rest = Array(count).fill(0);
  for (const word of block) {
    const factor = word ^ rest.shift();
    rest.push(0);
    for (let i = 0; i < count; ++i) rest[i] ^= times(generator[i + 1], factor);
  }
  return rest;
}

function drawn(version, words, mask) {
  const size = 17 + 4 * version;
  const modules = Array.from({ length: size }, () => Array(size).fill(null));
  const set = (y, x, dark) => { if (y >= 0 && x >= 0 && y < size && x < size) modules[y][x] = Boolean(dark); };
  const square = (y, x, radius, isDark) => {
    for (let dy = -radius; dy <= radius; ++dy) for (let dx = -radius; dx <= radius; ++dx) set(y + dy, x + dx, isDark(Math.max(Math.abs(dy), Math.abs(dx))));
  };
  for (const [y, x] of [[3, 3], [3, size - 4], [size - 4, 3]]) square(y, x, 4, (ring) => ring !== 2 && ring !== 4);
  for (let i = 8; i < size - 8; ++i) [[6, i], [i, 6]].forEach(([y, x]) => set(y, x, i % 2 === 0));
  const [first, last] = [6, size - 7];
  // The three corners hold the finders.
  const isFinder = (y, x) => [`${first},${first}`, `${first},${last}`, `${last},${first}`].includes(`${y},${x}`);
  for (const y of ALIGNMENTS[version]) for (const x of ALIGNMENTS[version]) if (!isFinder(y, x)) square(y, x, 2, (ring) => ring !== 1);
  drawFormat(set, size, bch((LEVEL_M << 3) | mask, 0x537, 10) ^ 0x5412);
  if (version >= 7) drawVersion(set, size, bch(version, 0x1F25, 12));
  fill(modules, words, MASKS[mask]);
  return modules;
}

/** A number with the remainder of its division by a generator behind it. */
function bch(value, generator, count) {
  let rest = value;
  for (let i = 0; i < count; ++i) rest = (rest << 1) ^ (rest >> (count - 1)) * generator;
  return value << count | rest;
}

function drawFormat(set, size, bits) {
  for (let i = 0; i < 15; ++i) {
    const dark = bits >> i & 1;
    set(i < 6 ? i : i < 8 ? i + 1 : size - 15 + i, 8, dark);
    set(8, i < 8 ? size - 1 - i : i === 8 ? 7 : 14 - i, dark);
  }
  set(size - 8, 8, true);
}

function drawVersion(set, size, bits) {
  for (let i = 0; i < 18; ++i) {
    const [far, near] = [size - 11 + i % 3, Math.floor(i / 3)];
    set(near, far, bits >> i & 1);
    set(far, near, bits >> i & 1);
  }
}

/** Two columns at a time, upwards and downwards in turn, from the right; the sixth column holds the clock. */
function fill(modules, words, masked) {
  const size = modules.length;
  let bit = 0;
  for (let right = size - 1, up = true; right > 0; right -= right === 8 ? 3 : 2, up = !up) {
    for (let i = 0; i < size; ++i) {
      const y = up ? size - 1 - i : i;
      for (const x of [right, right - 1].filter((each) => modules[y][each] === null)) {
        modules[y][x] = Boolean((words[bit >> 3] >> (7 - (bit & 7)) & 1) ^ !masked(y, x));
        ++bit;
      }
    }
  }
}

/** How hard a code is to read: long runs, squares, what looks like a finder, too much of one colour. */
function penalty(modules) {
  const size = modules.length;
  const lines = [...modules, ...modules[0].map((_, x) => modules.map((row) => row[x]))].map((line) => line.map((dark) => (dark ? '1' : '0')).join(''));
  let sum = 0;
  for (const line of lines) {
    for (const [run] of line.matchAll(/0{5,}|1{5,}/g)) sum += run.length - 2;
    for (const pattern of ['10111010000', '00001011101']) for (let at = line.indexOf(pattern); at >= 0; at = line.indexOf(pattern, at + 1)) sum += 40;
  }
  for (let y = 1; y < size; ++y) {
    for (let x = 1; x < size; ++x) if (modules[y][x] === modules[y - 1][x] && modules[y][x] === modules[y][x - 1] && modules[y][x] === modules[y - 1][x - 1]) sum += 3;
  }
  const share = 100 * modules.flat().filter(Boolean).length / size ** 2;
  return sum + 10 * Math.floor(Math.abs(share - 50) / 5);
}
