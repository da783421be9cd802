/** How often a characteristic is measured: what the words of a plan say, and whether it is due. */

/** What the words may end with, in four languages: parts, or how many minutes a period has. */
const UNITS = {
  parts: 'part parts piece pieces pcs teil teile stück onderdeel onderdelen stuk stuks pezzo pezzi',
  1: 'minute minutes min minuten minuut minuto minuti',
  60: 'hour hours h hourly stunde stunden stündlich uur uren ora ore',
  1440: 'day days daily tag tage täglich dag dagen dagelijks giorno giorni',
};
const UNIT = new Map(Object.entries(UNITS).flatMap(([unit, words]) => words.split(' ').map((word) => [word, unit])));
const EACH = 'each|every|per|an?|jede[rsnm]?|alle|pro|je|elke?|ogni';
const WORDS = new RegExp(`^(?:(?<samples>\\d+) (?:of |von |van |di )?(?=(?:${EACH}) ))?(?:(?:${EACH}) )?(?:(?<every>\\d+)(?:(?:st|nd|rd|th|\\.|e|º|°)(?= ))? ?)?(?<unit>\\p{L}+)$`, 'u');
const LONGEST = 500;
const MINUTE_MS = 60000;

/**
 * "every 5th part", "each hour", "3 of each hour", "every 30 minutes", "jedes 5. Teil".
 * @returns {samples, parts} or {samples, period}, in ms; null where there are no such words: then it is due at each part
 */
export function frequencyOf(words = '') {
  const { samples = 1, every = 1, unit } = WORDS.exec(words.trim().replace(/\s+/g, ' ').toLowerCase())?.groups ?? {};
  const what = UNIT.get(unit);
  const count = Number(every);
  if (!what || Number(samples) < 1 || count < 1 || count > LONGEST || Number(samples) > LONGEST) return null;
  return what === 'parts' ? { samples: Number(samples), parts: count } : { samples: Number(samples), period: count * Number(what) * MINUTE_MS };
}

const zoneAt = (moment) => new Date(moment).getTimezoneOffset() * MINUTE_MS;

/**
 * When the period began that a moment is in: hours and days are those on the clock of the wall, also where that is put forward or back.
 * @param later so many periods after that one
 */
export function periodStart(now, period, later = 0) {
  const zone = zoneAt(now);
  const wall = (Math.floor((now - zone) / period) + later) * period;
  return wall + zoneAt(wall + zone);
}

/** Values by their sample, in order of its begin: {name, begin, last, parts}. Without a size each is one. */
export function samplesOf(values, size) {
  const named = new Map();
  for (const { at, part, subgroup } of values) {
    if (size > 1 && !subgroup) continue;
    const name = size > 1 ? subgroup : named.size;
    const sample = named.get(name) ?? { name, begin: at, parts: [], count: 0 };
    named.set(name, Object.assign(sample, { last: at, parts: [...sample.parts, part], count: sample.count + 1 }));
  }
  return [...named.values()];
}

/** How many parts were measured since a sample began, but for its first one and the one that lies there now. */
export function partsSince(sample, { counted, part, uncounted }) {
  const since = counted.filter(({ at }) => at >= sample.begin);
  const named = new Set(since.map((each) => each.part).filter((each) => each && each !== part && each !== sample.parts[0]));
  return named.size + Math.max(since.filter((each) => !each.part).length - uncounted(sample), 0);
}

/**
 * Whether a characteristic is due.
 * @param samples of it; @param size of one; @param isOwn tells those of this station: only these it goes on with
 * @param frequency from `frequencyOf`, or null; @param parts what `partsSince` counts, null where nothing can be counted
 * @returns {due, open: the sample that was begun, parts | until: how long it is not}
 */
export function standing({ samples, size, isOwn, frequency, parts, part, now }) {
  const own = samples.filter(isOwn).at(-1);
  const old = frequency && own && (frequency.period ? now - own.last >= frequency.period : parts && partsSince(own, parts) >= frequency.parts);
  if (own && own.count < size && !old) return { due: !(part && own.parts.includes(part)), open: own };
  if (frequency?.period) {
    const start = periodStart(now, frequency.period);
    const taken = samples.filter(({ begin }) => begin >= start).length;
    return taken < frequency.samples ? { due: true } : { due: false, until: periodStart(now, frequency.period, 1) };
  }
  const before = frequency && parts && samples.at(-frequency.samples);
  if (!before) return { due: true };
  const left = frequency.parts - 1 - partsSince(before, parts);
  return left > 0 ? { due: false, parts: left } : { due: true };
}
