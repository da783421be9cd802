/** A run block by block: what each block has moved and changed, and how long each tool was in the spindle. */

import { KINDS } from '../figures/trace.js';

/** The names of parameters in a text, each once, at most as many as a run watches. */
export function parametersIn(text, most = 32) {
  return [...new Set([...text.replace(/;.*$/gm, '').matchAll(/\bQ[LRS]?\d+\b/gi)].map(([name]) => name.toUpperCase()))].slice(0, most);
}

export class Steps {
  /** @param trace with blocks */
  constructor(trace) {
    this.trace = trace;
    this.blocks = trace.blocks;
    this.length = this.blocks.length;
    /** The last move that was made when a block was done; -1 before the first. */
    this.lastMove = new Int32Array(this.length);
    this.blockAt = new Int32Array(trace.length);
    let next = 0;
    this.blocks.forEach(({ moves }, i) => {
      while (next < Math.min(moves, trace.length)) this.blockAt[next++] = i;
      this.lastMove[i] = next - 1;
    });
  }

  /** [name, value before, value after] of what a block has changed. */
  changesAt(i) {
    const before = this.blocks[i - 1]?.values ?? {};
    return Object.entries(this.blocks[i].values).filter(([name, value]) => before[name] !== value).map(([name, value]) => [name, before[name], value]);
  }

  /** The next block from `i` at which one of the breakpoints stops; -1 without one. @param way 1 or -1 */
  find(breaks, i, way) {
    for (let at = i + way; at >= 0 && at < this.length; at += way) if (breaks.some((stops) => stops(this, at))) return at;
    return -1;
  }

  /** [{tool, seconds: by kind of move, total}] in the order of their first use. */
  toolTimes() {
    const tools = new Map();
    let next = 0;
    this.blocks.forEach(({ tool }, i) => {
      for (; next <= this.lastMove[i]; ++next) {
        const own = tools.get(tool) ?? { tool, seconds: Object.fromEntries(KINDS.map((kind) => [kind, 0])), total: 0 };
        const { kind, seconds } = this.trace.at(next);
        own.seconds[kind] += seconds;
        own.total += seconds;
        tools.set(tool, own);
      }
    });
    return [...tools.values()];
  }
}
