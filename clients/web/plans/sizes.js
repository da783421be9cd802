/** Sizes with limits as people write them, and as a plan has them: 25 H7, M10-6H, 8 +0.036/0, 40 ±0.1, 12 ≥ 11.9. */

import { Decimal, mmText, nmFromMm, nmFromUm, parseLength, parseSigned } from '../exact.js';
import { number } from '../i18n.js';

const SIZE = '[Øø⌀∅\\s]*([\\-−]?\\d[\\d.,]*)\\s*(?:mm)?';
const END = '(?:\\s*mm)?$';
const BOTH = new RegExp(`^${SIZE}\\s*(?:±|\\+/?-)\\s*(\\d[\\d.,]*)${END}`);
const TWO = new RegExp(`^${SIZE}(?:\\s+|(?=[+\\-−]))([+\\-−]?\\d[\\d.,]*)\\s*[/\\s]\\s*([+\\-−]?\\d[\\d.,]*)${END}`);
const ONE = new RegExp(`^(?:${SIZE})?\\s*([≤≥]|[<>]=)\\s*([\\-−]?\\d[\\d.,]*)${END}`);

/** The members of a characteristic that say its limits; the others are kept as they are. */
export const LIMITS = ['designation', 'nominal_mm', 'tolerance_class', 'upper_um', 'lower_um'];

/** What is measured, as the members of a characteristic: a class says itself whether it is a hole or a shaft. */
export const KINDS = {
  '': {}, hole: { feature: 'hole' }, shaft: { feature: 'shaft' },
  width: { quantity: 'width' }, width_hole: { feature: 'hole', quantity: 'width' }, width_shaft: { feature: 'shaft', quantity: 'width' },
  ...Object.fromEntries(['distance', 'radius', 'chamfer', 'position', 'deviation', 'pitch_diameter'].map((quantity) => [quantity, { quantity }])),
};

/** The name of a kind of KINDS. */
export function kindOf({ feature, quantity }) {
  const own = quantity === 'diameter' ? undefined : quantity;
  const found = Object.keys(KINDS).find((name) => KINDS[name].feature === feature && KINDS[name].quantity === own);
  return found ?? (own && KINDS[own] ? own : '');
}

/** A decimal of mm as one of µm, digit by digit. */
export function umOfMm(mm) {
  const [, sign, whole, fraction = ''] = /^(-?)(\d+)(?:\.(\d+))?$/.exec(mm);
  const digits = fraction.padEnd(3, '0');
  const um = `${whole}${digits.slice(0, 3)}`.replace(/^0+(?=\d)/, '');
  const rest = digits.slice(3).replace(/0+$/, '');
  return (um === '0' && !rest ? '' : sign) + um + (rest && `.${rest}`);
}

const um = (mm) => new Decimal(umOfMm(mm));
const given = (members) => Object.fromEntries(Object.entries(members).filter(([, value]) => value !== undefined));

/** A limit alone, beside its nominal size or without: {nominal_mm, upper_um or lower_um}; null if it is finer than 1 nm. */
function oneLimit([, size, sign, text], kind) {
  const limit = parseSigned(text);
  const nominal = size ? parseLength(size) : kind === 'deviation' ? '0' : limit;
  if (nominal === null || limit === null || /\.\d{6}\d*[1-9]/.test(limit)) return null;
  const deviation = um(mmText(nmFromMm(limit) - nmFromMm(nominal), 0));
  return { nominal_mm: new Decimal(nominal), ...(/[≤<]/.test(sign) ? { upper_um: deviation } : { lower_um: deviation }) };
}

/** The members for what was typed; what is none of these is a designation, which the service reads. */
export function limitsTyped(typed, kind = '') {
  const text = typed.trim();
  const [both, two, one] = [BOTH, TWO, ONE].map((form) => form.exec(text));
  if (one) return oneLimit(one, kind) ?? { designation: text };
  const parts = both ? [both[1], both[2], `-${both[2]}`] : two ? two.slice(1) : [];
  const [nominal, ...deviations] = parts.map((part, i) => (i ? parseSigned(part) : parseLength(part)));
  if (!parts.length || [nominal, ...deviations].includes(null)) return { designation: text };
  const [upper, lower] = deviations.sort((first, second) => nmFromMm(second) - nmFromMm(first));
  return { nominal_mm: new Decimal(nominal), upper_um: um(upper), lower_um: um(lower) };
}

/** A designation that leaves open whether a hole or a shaft is measured. */
const isOpen = (designation) => /ISO\s*2768/i.test(designation);

/** The members of a size: its limits, and what is measured. A class that says hole or shaft itself is not told so again. */
export function sizeMembers(typed, kind) {
  const limits = typed.trim() ? limitsTyped(typed, kind) : {};
  const { feature, quantity } = KINDS[kind] ?? {};
  return given({ ...limits, feature: limits.designation && !isOpen(limits.designation) ? undefined : feature, quantity });
}

/** What somebody would type for the limits of a characteristic. */
export function sizeTyped(one) {
  if (one.designation !== undefined) return one.designation;
  if (one.tolerance_class !== undefined) return `${number(one.nominal_mm)} ${one.tolerance_class}`;
  if (one.nominal_mm === undefined) return '';
  const [upper, lower] = [one.upper_um, one.lower_um].map((value) => (value === undefined ? undefined : nmFromUm(value)));
  const nominal = number(one.nominal_mm);
  const mm = (nm) => number(mmText(nm, 0));
  if (upper === undefined && lower === undefined) return nominal;
  if (lower === undefined) return `${nominal} ≤ ${mm(nmFromMm(one.nominal_mm) + upper)}`;
  if (upper === undefined) return `${nominal} ≥ ${mm(nmFromMm(one.nominal_mm) + lower)}`;
  if (upper === -lower && upper > 0) return `${nominal} ±${mm(upper)}`;
  return `${nominal} ${[upper, lower].map((nm) => (nm > 0 ? '+' : '') + mm(nm)).join('/')}`;
}
