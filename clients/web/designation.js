/** Designations as people type them: Ø25H7, 25 h7, 132,5/a13, 25H7/g6. */

import { nmFromMm, parseMeasured } from './exact.js';

const DESIGNATION = /^[Øø⌀∅\s]*([\d.,]+)\s*(?:mm)?\s*\/?\s*([A-Za-z]\w*)$/;
const FIT = /^[Øø⌀∅\s]*([\d.,]+)\s*(?:mm)?\s*([A-Z]\w*)\s*[/\s-]\s*([a-z]\w*)$/;

/** {text: "25H7", nominal_nm, tolerance_class}; null where it cannot be one. */
export function parseDesignation(typed) {
  const match = DESIGNATION.exec(typed.trim());
  const nominal = match && parseMeasured(match[1]);
  return nominal && { text: nominal + match[2], nominal_nm: nmFromMm(nominal), tolerance_class: match[2] };
}

/** {size: "25", hole: "H7", shaft: "g6"}; null where it cannot be one. */
export function parseFit(typed) {
  const match = FIT.exec(typed.trim());
  const size = match && parseMeasured(match[1]);
  return size && { size, hole: match[2], shaft: match[3] };
}
