/**
 * Exact decimals. A typed or received number stays text, and what is computed with is a whole number
 * of nanometres: at most 10^14, which a JavaScript number holds exactly. `String(n)` of a number of a
 * JSON answer is its decimal text again, because lengths have at most 15 significant digits.
 */

export const NM_PER_MM = 1e6;
export const NM_PER_UM = 1e3;
/** The service takes measured values up to here. */
export const LARGEST_NM = 1e8 * NM_PER_MM;

/** A number for JSON, written with the digits it was typed with. */
export class Decimal {
  constructor(text) {
    this.text = text;
  }

  /** For JSON.stringify: text where a number would lose digits. */
  toJSON() {
    return this.text.replace(/\D/g, '').replace(/^0+/, '').length > 15 ? this.text : Number(this.text);
  }
}

const MEASURED = /^\+?(?:(\d+)(?:[.,](\d*))?|[.,](\d+))(?:\s*mm)?$/;
const SIGNED = /^([+\-−]?)(\d+)(?:[.,](\d+))?$/;

/** A typed length with point or comma, as "25.0081"; null for anything else. */
export function parseMeasured(typed) {
  const match = MEASURED.exec(typed.trim());
  if (!match) return null;
  return join((match[1] ?? '0'), match[2] ?? match[3] ?? '');
}

/** A typed deviation or other signed number, as "-0.5"; null for anything else. */
export function parseSigned(typed) {
  const match = SIGNED.exec(typed.trim());
  if (!match) return null;
  const sign = match[1] && match[1] !== '+' ? '-' : '';
  return sign + join(match[2], match[3] ?? '');
}

/** A typed length that may be 0 or less, as "-0.5"; null for anything else. */
export const parseLength = (typed) => parseMeasured(typed) ?? parseSigned(typed);

/** The least measured value in nm: a position, a distance and a deviation may be 0 or less. */
export const leastOf = (limits) => (['position', 'distance', 'deviation'].includes(limits?.quantity) ? -LARGEST_NM : 1);

function join(whole, fraction) {
  const digits = whole.replace(/^0+(?=\d)/, '');
  return fraction ? `${digits}.${fraction}` : digits;
}

/** A decimal (text, or a number of a JSON answer) times 10^scale, rounded to a whole number. */
function scaled(value, scale) {
  const match = /^(-?)(\d+)(?:\.(\d+))?$/.exec(String(value));
  if (!match) return NaN;
  const fraction = (match[3] ?? '').padEnd(scale + 1, '0');
  const size = Number(match[2] + fraction.slice(0, scale)) + (fraction[scale] >= '5' ? 1 : 0);
  return match[1] ? -size : size;
}

export const nmFromMm = (value) => scaled(value, 6);
export const nmFromUm = (value) => scaled(value, 3);

/** Whole nanometres as the decimal of a unit, with at least `places` decimals. */
function unscaled(nm, scale, places) {
  const digits = String(Math.abs(nm)).padStart(scale + 1, '0');
  const whole = digits.slice(0, -scale);
  const fraction = digits.slice(-scale).replace(/0+$/, '').padEnd(places, '0');
  return (nm < 0 ? '-' : '') + (fraction ? `${whole}.${fraction}` : whole);
}

export const mmText = (nm, places = 3) => unscaled(nm, 6, places);
export const umText = (nm) => unscaled(nm, 3, 0);

/** [lower, upper] limit of a job or a record in nm; infinite where a drawing has none. */
export const boundsOf = ({ lower_limit_mm: lower, upper_limit_mm: upper }) =>
  [lower === undefined ? -Infinity : nmFromMm(lower), upper === undefined ? Infinity : nmFromMm(upper)];

/** The verdicts below and above the limits: rework where material can still be removed, as from a broken edge. */
function beyond({ feature, quantity, tolerance_class: of }) {
  if (feature === 'hole' || ['radius', 'chamfer'].includes(quantity) || /^[RC] ISO 2768/.test(of)) return ['rework', 'reject'];
  return feature ? ['reject', 'rework'] : ['reject', 'reject'];
}

/**
 * The verdict of whole nanometres, as the service gives it (limits inclusive); null where this page
 * cannot tell. @param guard k times u in nm: beside a limit by less, the value is indeterminate
 */
export function judge(measured, limits, guard = 0) {
  const [lower, upper] = boundsOf(limits);
  const below = lower - measured;
  const above = measured - upper;
  if (!Number.isSafeInteger(guard) || ![below, above].every((nm) => Number.isSafeInteger(nm) || nm === -Infinity)) return null;
  if (below <= -guard && above <= -guard) return 'good';
  if (below > guard) return beyond(limits)[0];
  if (above > guard) return beyond(limits)[1];
  return 'indeterminate';
}

/** JSON of a value; a Decimal is written digit by digit. */
export function toJson(value) {
  if (value instanceof Decimal) return value.text;
  if (Array.isArray(value)) return `[${value.map(toJson).join(',')}]`;
  if (value && typeof value === 'object') {
    const members = Object.entries(value).filter(([, member]) => member !== undefined);
    return `{${members.map(([name, member]) => `${JSON.stringify(name)}:${toJson(member)}`).join(',')}}`;
  }
  return JSON.stringify(value);
}
