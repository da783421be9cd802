/** Breakpoints of a program, as they are typed: kept for the window, and the same in the editor's gutter and below a run. */

import { readJson, store } from '../stored.js';
import { fileName, relative } from './disk.js';

const PLACE = /^(?:([^:]+?)\s*:\s*)?N?(\d+)$/i;
const CONDITION = /^(Q[LRS]?\d+)(?:\s*(<=|>=|<>|!=|==?|<|>)\s*(.+))?$/i;
const COMPARE = {
  '<': (one, other) => one < other, '>': (one, other) => one > other, '<=': (one, other) => one <= other, '>=': (one, other) => one >= other,
  '=': (one, other) => one === other, '==': (one, other) => one === other, '<>': (one, other) => one !== other, '!=': (one, other) => one !== other,
};

const isSame = (one, other) => fileName(one).toLowerCase() === fileName(other).toLowerCase();
const listOf = (typed) => typed.split(',').map((text) => text.trim()).filter(Boolean);

/** The block that a breakpoint names, if it is one of `of`, which `program` calls or is. */
function blockOf(text, program, of) {
  const place = PLACE.exec(text);
  return place && isSame(place[1] ?? program, of) ? Number(place[2]) : null;
}

const keptAs = (program) => `breaks.${relative(program).toLowerCase()}`;
export const keptBreaks = (program) => readJson(keptAs(program), '', 'session');

/** Keeps them; `breaks` is dispatched to whatever shows them. */
export function keepBreaks(program, typed) {
  store(keptAs(program), JSON.stringify(typed), 'session');
  dispatchEvent(new Event('breaks'));
}

/** The blocks of a program that have one. */
export const brokenBlocks = (program, of) => new Set(listOf(keptBreaks(program)).map((text) => blockOf(text, program, of)).filter((block) => block !== null));

/** Sets a breakpoint at a block, or removes it. */
export function toggleBreak(program, of, block) {
  const list = listOf(keptBreaks(program));
  const others = list.filter((text) => blockOf(text, program, of) !== block);
  if (others.length === list.length) others.push(isSame(of, program) ? String(block) : `${fileName(of)}:${block}`);
  keepBreaks(program, others.join(', '));
}

/**
 * Breakpoints by commas: `31`, `N31` or `82551.h:35` (a block), `Q5` (whenever it changes), `Q5 > 10` (when that becomes true).
 * @param complain makes the text of what is none. @returns functions of (steps, index)
 */
export function readBreaks(typed, program, complain) {
  return listOf(typed).map((text) => {
    if (PLACE.test(text)) return ({ blocks }, i) => blockOf(text, program, blocks[i].program) === blocks[i].block;
    const [whole, left, sign, right] = CONDITION.exec(text) ?? [];
    if (!whole) throw new Error(complain(text));
    const name = left.toUpperCase();
    if (!sign) return (steps, i) => steps.changesAt(i).some(([changed]) => changed === name);
    const wanted = /^[+-]?\d+([.,]\d+)?$/.test(right) ? Number(right.replace(',', '.')) : right.replace(/^"(.*)"$/, '$1');
    const isTrue = (values) => {
      const other = CONDITION.test(right) ? values[right.toUpperCase()] : wanted;
      return values[name] !== undefined && other !== undefined && COMPARE[sign](values[name], other);
    };
    return ({ blocks }, i) => isTrue(blocks[i].values) && !(i > 0 && isTrue(blocks[i - 1].values));
  });
}
