/** Ranks by time. The service counts what it received before a time, and lists from a time on: so a row far down a long list is reached. */

/** As near as this many rows is near enough: they are read and left out. */
const REACH = 200;

export class Ladder {
  /**
   * @param total rows there are, the oldest of rank 0
   * @param first when the oldest was received, in ms; @param last the newest
   * @param count takes a time in ms and a signal: resolves to how many rows were received before
   */
  constructor(total, first, last, count) {
    // Of the two ends no time is known for certain: a centre stores late what a station has kept.
    this.steps = [{ rank: 0, ms: first, isEnd: true }, { rank: total, ms: last + 1, isEnd: true }];
    Object.assign(this, { total, count });
  }

  /** The step nearest to a rank: so many rows are older than its time. Within one import, whose rows came at once, it may be thousands away. */
  async near(rank, signal) {
    for (;;) {
      const above = this.steps.findIndex((step) => step.rank > rank);
      const [lo, hi] = this.steps.slice(above - 1, above + 1);
      const isLow = rank - lo.rank <= hi.rank - rank;
      if (Math.min(rank - lo.rank, hi.rank - rank) <= REACH || hi.ms - lo.ms <= 1) return isLow ? lo : hi;
      await this.#climb(lo, hi, (rank - lo.rank) / (hi.rank - lo.rank), signal);
    }
  }

  /** Counts at times about the likely one, and at thirds, where rows came in bursts. */
  async #climb(lo, hi, share, signal) {
    const span = hi.ms - lo.ms;
    const times = new Set([share - 1 / 64, share + 1 / 64, 1 / 3, 2 / 3].map((part) =>
      Math.min(Math.max(Math.round(lo.ms + span * part), lo.ms + 1), hi.ms - 1)));
    const found = await Promise.all([...times].map(async (ms) => ({ rank: await this.count(ms, signal), ms })));
    this.steps = [...this.steps, ...found].sort((one, other) => one.ms - other.ms);
  }
}
