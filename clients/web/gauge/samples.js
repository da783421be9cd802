/** The samples of a plan: what there is of its characteristics, from this station and others, stored and on its way. */

import { getJson, PATIENCE_MS, url } from '../api.js';
import { connection } from '../connection.js';
import { parseDesignation } from '../designation.js';
import { queue, randomText } from '../queue.js';
import { LaterStore, readJson, readStored, store } from '../stored.js';
import { frequencyOf, samplesOf, standing } from './frequency.js';

const MOST = 1000;
const FEWEST = 50;
/** Of the part number in a sample's name, which has 200 bytes. */
const LONGEST_PART = 40;

const isSampled = (one) => one.subgroup_size > 1 || frequencyOf(one.frequency) !== null;
const sameText = (one, other) => (parseDesignation(one)?.text ?? one) === (parseDesignation(other)?.text ?? other);
const sameNumber = (one, other) => (one === undefined ? one === other : Number(one) === Number(other));

/** Whether a record is of a characteristic: another part number may have one of the same name. */
function isOf(record, one) {
  if (record.characteristic !== one.name) return false;
  const designation = one.designation ?? (one.tolerance_class && `${one.nominal_mm}${one.tolerance_class}`);
  if (designation) return sameText(record.designation ?? '', designation);
  return sameNumber(one.nominal_mm, record.nominal_mm) && sameNumber(one.upper_um, record.upper_deviation_um) && sameNumber(one.lower_um, record.lower_deviation_um);
}

let sign = readStored('station') ?? '';
/** Tells this browser's samples from those of another. */
function ownSign() {
  if (!sign) store('station', sign = randomText().slice(0, 6));
  return sign;
}

export class Samples {
  #known = new Map();
  #key;
  /** Told while a value of this station's own was on its way. */
  #later = [];
  /** Stored while the list was read: they may not be in it. */
  #meanwhile = [];

  /** @param machine whose parts are counted, '' for all; @param onChange is told of values of others; @param leaving ends it */
  constructor({ machine, onChange, leaving }) {
    Object.assign(this, { machine, onChange, plan: undefined });
    queue.addEventListener('change', () => this.#takeLater(), { signal: leaving });
    connection.addEventListener('change', () => connection.up && this.renew(), { signal: leaving });
    this.kept = new LaterStore(() => store(this.#key, JSON.stringify(Object.fromEntries(this.#known))), leaving);
  }

  /** Takes up a plan: reads what there is of it, or what was kept where the service is away. */
  async load(plan) {
    this.kept.flush();
    this.plan = plan;
    this.counted = undefined;
    this.watched = (plan?.characteristics ?? []).filter(isSampled);
    if (!this.watched.length) return;
    // Parts are counted by what is measured at each of them.
    if (this.watched.some(({ frequency }) => frequencyOf(frequency)?.parts)) this.counted = plan.characteristics.find((one) => !isSampled(one));
    this.of = this.machine();
    this.#key = `samples.${plan.part}.${this.of}`;
    this.#known = new Map(Object.entries(readJson(this.#key, {})));
    this.#meanwhile = [];
    const found = connection.up ? await Promise.all([...this.watched, this.counted].filter(Boolean).map((one) => this.#read(one))).catch(() => []) : [];
    if (this.plan !== plan || !found.length) return;
    for (const [name, values] of found) this.#known.set(name, values);
    for (const record of this.#meanwhile) this.#add(record);
    this.kept.changed();
  }

  /** The samples of another machine are others. */
  get ofAnother() {
    return this.watched?.length > 0 && this.of !== this.machine();
  }

  /** Reads anew: values may have come that nobody told of. */
  async renew() {
    if (!this.watched?.length) return;
    await this.load(this.plan);
    this.onChange();
  }

  async #read(one) {
    const size = one.subgroup_size ?? 1;
    const limit = one === this.counted ? MOST : Math.min(MOST, Math.max(FEWEST, 3 * size * (frequencyOf(one.frequency)?.samples ?? 1)));
    const { measurements } = await getJson(url(['measurements'], { characteristic: one.name, machine: this.machine(), sort: 'newest', limit }), { timeout: PATIENCE_MS, asks: false });
    return [one.name, measurements.filter((record) => isOf(record, one)).map(valueOf).sort(byTime)];
  }

  /** A record was stored, here or elsewhere. */
  take(record) {
    if (!this.#of(record) && !record.correction_of) return;
    this.#meanwhile.push(record);
    this.#add(record);
    this.kept.changed();
    this.onChange();
  }

  /** A correction may be of another characteristic, or of another machine, than what it corrects. */
  #add(record) {
    for (const [name, values] of this.#known) this.#known.set(name, values.filter(({ id }) => id !== record.correction_of));
    const { name } = this.#of(record) ?? {};
    const values = this.#known.get(name) ?? [];
    if (!name || values.some(({ id }) => id === record.id)) return;
    this.#known.set(name, [...values, valueOf(record)].sort(byTime).slice(-MOST));
  }

  /** The service tells of a record: one of this station's own has its answer first. */
  told(record) {
    if (queue.values.length) this.#later.push(record);
    else this.take(record);
  }

  #takeLater() {
    if (!queue.values.length) for (const record of this.#later.splice(0)) this.take(record);
  }

  #of(record) {
    if ((record.machine ?? '') !== this.machine() && this.machine()) return undefined;
    return this.watched?.length ? [...this.watched, this.counted].find((one) => one && isOf(record, one)) : undefined;
  }

  /** The values of a characteristic, those that wait among them. */
  #values(one) {
    const waiting = queue.everywhere.map(({ path, shown }) => path === url(['measurements']) && { ...shown.limits, ...shown, measured_at: shown.at })
      .filter((record) => record && this.#of(record) === one).map(valueOf);
    return [...(this.#known.get(one.name) ?? []), ...waiting].sort(byTime);
  }

  /**
   * How it is with a characteristic at a part: {due, at, size, parts, until}; `at` counts the values of the sample.
   * @param taken whether what parts are counted by is measured at this one
   */
  standing(one, part, taken) {
    const size = one.subgroup_size ?? 1;
    if (!this.watched?.includes(one)) return { due: true, at: 0, size };
    const begins = this.#beginning;
    const values = this.#values(one).filter(({ subgroup }) => size === 1 || subgroup?.startsWith(begins));
    const order = this.plan.characteristics;
    const before = this.counted && order.indexOf(one) < order.indexOf(this.counted);
    const { open, ...rest } = standing({
      samples: samplesOf(values, size), size, isOwn: ({ name }) => String(name).endsWith(ownSign()), frequency: frequencyOf(one.frequency), part,
      now: connection.now().getTime(),
      parts: this.counted ? { part, counted: this.#values(this.counted), uncounted: (sample) => (before && !sample.parts[0] ? 1 : 0) + (taken && !part ? 1 : 0) } : null,
    });
    return { ...rest, at: open?.count ?? 0, size, sample: open?.name };
  }

  get #beginning() {
    return `${this.plan.part.slice(0, LONGEST_PART)} `;
  }

  /** The sample that the next value of a characteristic belongs to; undefined where it is no more than one value. */
  sampleOf(one) {
    const { size, sample } = this.standing(one, '', false);
    return size === 1 ? undefined : sample ?? `${this.#beginning}${connection.now().toISOString()} ${ownSign()}`;
  }
}

const valueOf = ({ id, part_id: part, subgroup, measured_at: at }) => ({ id, part, subgroup, at: new Date(at).getTime() });
const byTime = (one, other) => one.at - other.at;
